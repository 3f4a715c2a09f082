// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for what is inside a 3MF: the XML of its parts, which no fuzzer reaches through a packed archive
// with check sums. The bytes are the model part, then, each after a byte of 1, a second model part and the
// relationships; they are put in an archive unpacked. What fuzz_mesh promises holds here as well.
//   build/fuzz/tests/fuzz_three_mf -max_total_time=900 -max_len=8192 corpus/ tests/fuzz/seeds/three_mf
#include "core/error.h"
#include "mesh/read.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

std::uint32_t crc32(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int bit = 0; bit < 8; ++bit) t[i] = (t[i] >> 1U) ^ (t[i] & 1U ? 0xEDB88320U : 0U);
    }
    return t;
  }();
  std::uint32_t c = ~0U;
  for (const char b : bytes) c = table[(c ^ static_cast<unsigned char>(b)) & 255U] ^ (c >> 8U);
  return ~c;
}

/// An archive whose parts are not packed. Source: PKWARE's APPNOTE.TXT, 4.3.7, 4.3.12 and 4.3.16.
class StoredZip {
 public:
  void add(std::string_view name, std::string_view content) {
    const auto at = zip_.size();
    number(zip_, 0x04034b50, 4);
    facts(zip_, name, content);
    zip_.append(name).append(content);
    number(directory_, 0x02014b50, 4);
    number(directory_, 20, 2);
    facts(directory_, name, content);
    for (const int bytes : {2, 2, 2, 4}) number(directory_, 0, bytes);  // comment, disk, attributes
    number(directory_, at, 4);
    directory_.append(name);
    ++count_;
  }
  std::string bytes() const {
    std::string out = zip_ + directory_;
    number(out, 0x06054b50, 4);
    number(out, 0, 4);
    number(out, count_, 2);
    number(out, count_, 2);
    number(out, directory_.size(), 4);
    number(out, zip_.size(), 4);
    number(out, 0, 2);
    return out;
  }

 private:
  static void number(std::string& to, std::size_t value, int bytes) {
    for (int i = 0; i < bytes; ++i, value >>= 8U) to += static_cast<char>(value & 255U);
  }
  static void facts(std::string& to, std::string_view name, std::string_view content) {
    number(to, 20, 2);          // version
    number(to, 0, 4);           // flags, stored
    number(to, 0x00210000, 4);  // 1 January 1980
    number(to, crc32(content), 4);
    number(to, content.size(), 4);
    number(to, content.size(), 4);
    number(to, name.size(), 2);
    number(to, 0, 2);
  }
  std::string zip_, directory_;
  std::size_t count_ = 0;
};

constexpr std::string_view relationships =
    R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" )"
    R"(Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

std::string archive_of(std::string_view bytes) {
  std::array<std::string_view, 3> parts{{{}, {}, relationships}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto end = i + 1 < parts.size() ? bytes.find('\1') : bytes.npos;
    parts[i] = bytes.substr(0, end);
    if (end == bytes.npos) break;
    bytes.remove_prefix(end + 1);
  }
  StoredZip zip;
  zip.add("_rels/.rels", parts[2]);
  zip.add("3D/3dmodel.model", parts[0]);
  zip.add("3D/Objects/a.model", parts[1]);
  return zip.bytes();
}

void check(const Mesh& mesh) {
  require(!mesh.triangles.empty());
  for (const auto& t : mesh.triangles) {
    for (const auto corner : t) require(corner < mesh.vertices.size());
    require(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto archive = archive_of({reinterpret_cast<const char*>(data), size});
  try {
    const auto loaded = mesh::read(archive, "fuzz.3mf");
    require(loaded.format == mesh::Format::three_mf && !loaded.objects.empty());
    for (const auto& object : loaded.objects) check(object.mesh);
  } catch (const Error& error) {
    require(error.kind() == Error::Kind::model);
  }
  return 0;
}
