#include "mesh/archive.h"

#include "core/error.h"

#include <fmt/format.h>
#include <zip.h>

namespace weft::mesh {
namespace {

// XML of a mesh packs by a factor of 5 to 20. What grows further, beyond a size that does no harm, is a bomb.
constexpr std::uint64_t harmless_bytes = 64u << 20, most_bytes = std::uint64_t{8} << 30, most_growth = 150;

struct Closing {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

Error damaged(const std::string& where, const char* why) {
  return {Error::Kind::model, fmt::format("damaged archive: {}", why), where, "copy or export it again"};
}

}  // namespace

struct Archive::Zip {
  zip_t* handle = nullptr;
  ~Zip() {
    if (handle) zip_discard(handle);
  }
};

Archive::Archive(std::string_view bytes, const std::string& path) : zip_(std::make_unique<Zip>()), path_(path) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source) zip_->handle = zip_open_from_source(source, ZIP_RDONLY, &error);
  if (!zip_->handle) {
    const std::string why = zip_error_strerror(&error);
    if (source) zip_source_free(source);
    zip_error_fini(&error);
    throw damaged(path, why.c_str());
  }
  zip_error_fini(&error);
}

Archive::~Archive() = default;

bool Archive::has(const std::string& part) const {
  return zip_name_locate(zip_->handle, part.c_str(), ZIP_FL_NOCASE) >= 0;
}

void Archive::read(const std::string& part, const std::function<void(std::string_view piece)>& take) {
  const std::string where = path_ + "/" + part;
  const zip_int64_t index = zip_name_locate(zip_->handle, part.c_str(), ZIP_FL_NOCASE);
  if (index < 0) throw Error(Error::Kind::model, "not in the archive", where, "export the model again");
  zip_stat_t status;
  zip_stat_init(&status);
  const std::unique_ptr<zip_file_t, Closing> file(zip_fopen_index(zip_->handle, static_cast<zip_uint64_t>(index), 0));
  if (!file || zip_stat_index(zip_->handle, static_cast<zip_uint64_t>(index), 0, &status) != 0)
    throw damaged(where, zip_strerror(zip_->handle));
  packed_ += (status.valid & ZIP_STAT_COMP_SIZE) ? status.comp_size : 0;
  char buffer[1 << 16];
  while (const zip_int64_t got = zip_fread(file.get(), buffer, sizeof buffer)) {
    if (got < 0) throw damaged(where, zip_file_strerror(file.get()));
    unpacked_ += static_cast<std::uint64_t>(got);
    if (unpacked_ > most_bytes || (unpacked_ > harmless_bytes && unpacked_ / most_growth > packed_))
      throw Error(Error::Kind::model, fmt::format("unpacks to more than {} MB from {} bytes", unpacked_ >> 20, packed_),
                  where, "no model does: do not trust the file");
    take({buffer, static_cast<std::size_t>(got)});
  }
}

}  // namespace weft::mesh
