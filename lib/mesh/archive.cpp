// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/archive.h"

#include "core/error.h"
#include "core/stop.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <minizip/unzip.h>

namespace weft::mesh {
namespace {

// XML of a mesh packs by a factor of 5 to 20. What grows further, beyond a size that does no harm, is a bomb.
constexpr std::uint64_t harmless_bytes = 64u << 20, most_bytes = std::uint64_t{8} << 30, most_growth = 150;

constexpr int any_case = 2;  // of unzLocateFile

Error damaged(const std::string& where, std::string_view why) {
  return {Error::Kind::model, fmt::format("damaged archive: {}", why), where, "copy or export it again"};
}

std::string_view reason_of(int status) {
  switch (status) {
    case UNZ_CRCERROR:
      return "its check sum is wrong";
    case UNZ_BADZIPFILE:
      return "packed in a way that is not read, or cut short";
    default:
      return "what is packed cannot be unpacked";
  }
}

}  // namespace

/// The bytes as minizip reads them: as it would a file.
struct Archive::Zip {
  std::string_view bytes;
  std::uint64_t at = 0;
  unzFile handle = nullptr;

  explicit Zip(std::string_view all) : bytes(all) {
    zlib_filefunc64_def file{};
    file.opaque = this;
    file.zopen64_file = [](void* self, const void*, int) { return self; };
    file.zread_file = [](void* self, void*, void* to, uLong wanted) {
      return static_cast<Zip*>(self)->read(to, wanted);
    };
    file.ztell64_file = [](void* self, void*) -> ZPOS64_T { return static_cast<Zip*>(self)->at; };
    file.zseek64_file = [](void* self, void*, ZPOS64_T by, int from) {
      return static_cast<Zip*>(self)->seek(by, from);
    };
    file.zclose_file = [](void*, void*) { return 0; };
    file.zerror_file = [](void*, void*) { return 0; };
    handle = unzOpen2_64(nullptr, &file);
  }
  Zip(const Zip&) = delete;
  Zip& operator=(const Zip&) = delete;
  ~Zip() {
    if (handle) unzClose(handle);  // and the part that is being read
  }

 private:
  uLong read(void* to, uLong wanted) {
    const auto got = std::min<std::uint64_t>(wanted, bytes.size() - at);
    std::memcpy(to, bytes.data() + at, got);
    at += got;
    return got;
  }
  long seek(std::uint64_t by, int from) {
    const std::uint64_t base = from == ZLIB_FILEFUNC_SEEK_SET ? 0 : from == ZLIB_FILEFUNC_SEEK_CUR ? at : bytes.size();
    if (by > bytes.size() - base) return -1;
    at = base + by;
    return 0;
  }
};

Archive::Archive(std::string_view bytes, const std::string& path) : zip_(std::make_unique<Zip>(bytes)), path_(path) {
  if (!zip_->handle) throw damaged(path, "it has no directory where one should be");
}

Archive::~Archive() = default;

bool Archive::has(const std::string& part) const {
  return unzLocateFile(zip_->handle, part.c_str(), any_case) == UNZ_OK;
}

std::vector<std::string> Archive::parts() const {
  constexpr std::size_t most = 100'000, longest = 1024;
  std::vector<std::string> out;
  for (int status = unzGoToFirstFile(zip_->handle); status == UNZ_OK && out.size() < most;
       status = unzGoToNextFile(zip_->handle)) {
    char name[longest] = {};
    if (unzGetCurrentFileInfo64(zip_->handle, nullptr, name, longest - 1, nullptr, 0, nullptr, 0) != UNZ_OK) break;
    out.emplace_back(name);
  }
  return out;
}

void Archive::read(const std::string& part, const std::function<void(std::string_view piece)>& take) {
  const std::string where = path_ + "/" + part;
  if (!has(part)) throw Error(Error::Kind::model, "not in the archive", where, "export the model again");
  unz_file_info64 facts{};
  int status = unzGetCurrentFileInfo64(zip_->handle, &facts, nullptr, 0, nullptr, 0, nullptr, 0);
  if (status == UNZ_OK && (facts.flag & 1) != 0) throw damaged(where, "it is encrypted");
  constexpr uLong stored = 0;
  if (status == UNZ_OK && facts.compression_method != stored && facts.compression_method != Z_DEFLATED)
    status = UNZ_BADZIPFILE;  // minizip would give what is packed by bzip2 as it lies there
  if (status == UNZ_OK) status = unzOpenCurrentFile(zip_->handle);
  if (status != UNZ_OK) throw damaged(where, reason_of(status));
  packed_ += std::min<std::uint64_t>(facts.compressed_size, zip_->bytes.size());  // it is not believed beyond that
  std::uint64_t size = 0;
  char buffer[1 << 16];
  while (const int got = unzReadCurrentFile(zip_->handle, buffer, sizeof buffer)) {
    stop_if_asked();
    if (got < 0) throw damaged(where, reason_of(got));
    size += static_cast<std::uint64_t>(got), unpacked_ += static_cast<std::uint64_t>(got);
    if (unpacked_ > most_bytes || (unpacked_ > harmless_bytes && unpacked_ / most_growth > packed_))
      throw Error(Error::Kind::model, fmt::format("unpacks to more than {} MB from {} bytes", unpacked_ >> 20, packed_),
                  where, "no model does: do not trust the file");
    take({buffer, static_cast<std::size_t>(got)});
  }
  if (status = unzCloseCurrentFile(zip_->handle); status != UNZ_OK) throw damaged(where, reason_of(status));
  if (size != facts.uncompressed_size) throw damaged(where, reason_of(UNZ_BADZIPFILE));
}

std::string Archive::text(const std::string& part) {
  std::string out;
  read(part, [&](std::string_view piece) {
    out += piece;
    if (out.size() > harmless_bytes)
      throw Error(Error::Kind::model, fmt::format("is text of more than {} MB", harmless_bytes >> 20),
                  path_ + "/" + part, "no settings are: do not trust the file");
  });
  return out;
}

}  // namespace weft::mesh
