// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML format of images. Source: Kitware, "VTK file formats", XML file formats; ImageData.
#include "field/encoded.h"
#include "field/lattice.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include <expat.h>

namespace weft::field {
namespace {

/// A type of numbers, by VTK's name.
struct TypeRow {
  std::string_view name;
  std::size_t bytes;
  double (*value)(std::uint64_t bits);
};
template <class T, class Bits>
double value_as(std::uint64_t bits) {
  return static_cast<double>(std::bit_cast<T>(static_cast<Bits>(bits)));
}
constexpr std::array type_rows{
    TypeRow{"Float32", 4, value_as<float, std::uint32_t>},
    TypeRow{"Float64", 8, value_as<double, std::uint64_t>},
    TypeRow{"UInt8", 1, value_as<std::uint8_t, std::uint8_t>},
    TypeRow{"Int8", 1, value_as<std::int8_t, std::uint8_t>},
    TypeRow{"UInt16", 2, value_as<std::uint16_t, std::uint16_t>},
    TypeRow{"Int16", 2, value_as<std::int16_t, std::uint16_t>},
    TypeRow{"UInt32", 4, value_as<std::uint32_t, std::uint32_t>},
    TypeRow{"Int32", 4, value_as<std::int32_t, std::uint32_t>},
    TypeRow{"UInt64", 8, value_as<std::uint64_t, std::uint64_t>},
    TypeRow{"Int64", 8, value_as<std::int64_t, std::uint64_t>},
};

using Attributes = std::map<std::string, std::string, std::less<>>;

/// What of the file is wanted: the head, and the first array that may be the one.
struct Image {
  Attributes file, image, array;
  bool on_cells = false;
  std::string text;      ///< of the array, where it is not appended
  std::string appended;  ///< the attributes' coding: raw or base64
  bool found = false;
  int line = 0;
};

/// The elements of the file, as expat tells them.
class Listener {
 public:
  Listener(Image& to, Kind kind, XML_Parser parser) : to_(to), kind_(kind), parser_(parser) {}

  void start(std::string_view name, const char** attributes) {
    Attributes all;
    for (; *attributes != nullptr; attributes += 2) all[attributes[0]] = attributes[1];
    if (name == "VTKFile") to_.file = std::move(all);
    if (name == "ImageData") to_.image = std::move(all);
    if (name == "PointData" || name == "CellData") in_ = name == "CellData" ? In::cells : In::points;
    if (name == "AppendedData") to_.appended = all["encoding"];
    if (name == "DataArray" && in_ != In::nothing && !to_.found && fits(all)) {
      to_.array = std::move(all), to_.found = reads_ = true, to_.on_cells = in_ == In::cells;
      to_.line = static_cast<int>(XML_GetCurrentLineNumber(parser_));
    }
  }
  void end(std::string_view name) {
    if (name == "DataArray") reads_ = false;
    if (name == "PointData" || name == "CellData") in_ = In::nothing;
  }
  void text(std::string_view more) {
    if (reads_) to_.text += more;
  }

 private:
  enum class In { nothing, points, cells };

  bool fits(const Attributes& array) const {
    const auto components = array.find("NumberOfComponents");
    const std::string n = components == array.end() ? "1" : components->second;
    return kind_ == Kind::density ? n == "1" : n == "3" || n == "6" || n == "9";
  }

  Image& to_;
  Kind kind_;
  XML_Parser parser_;
  In in_ = In::nothing;
  bool reads_ = false;
};

extern "C" {
static void XMLCALL starts(void* listener, const char* name, const char** attributes) {
  static_cast<Listener*>(listener)->start(name, attributes);
}
static void XMLCALL ends(void* listener, const char* name) {
  static_cast<Listener*>(listener)->end(name);
}
static void XMLCALL says(void* listener, const char* text, int length) {
  static_cast<Listener*>(listener)->text({text, static_cast<std::size_t>(length)});
}
}

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& path, Kind kind) : bytes_(bytes), path_(path), kind_(kind) {}

  Lattice read() {
    take_elements();
    if (const std::string_view type = of(image_.file, "type"); type != "ImageData")
      refuse(fmt::format("{} is no regular grid", type.empty() ? "this" : type), "resample it to ImageData");
    if (!image_.found)
      refuse(kind_ == Kind::density ? "has no DataArray of one component" : "has no DataArray of 3, 6 or 9 components");
    Lattice out;
    take_shape(out);
    check_size(out, Words({}, path_));
    take_values(out);
    return out;
  }

 private:
  [[noreturn]] void refuse(std::string problem, std::string hint = {}) const {
    throw Error{Error::Kind::settings, std::move(problem), path_, std::move(hint)};
  }
  static std::string_view of(const Attributes& all, std::string_view key) {
    const auto at = all.find(key);
    return at == all.end() ? std::string_view() : std::string_view(at->second);
  }

  /// Appended bytes are none of XML: they are cut off and the elements closed by hand.
  void take_elements() {
    const std::size_t appended = bytes_.find("<AppendedData");
    std::string head(bytes_.substr(0, appended));
    if (appended != std::string_view::npos) {
      const std::size_t close = bytes_.find('>', appended);
      if (close == std::string_view::npos) refuse("ends within an element");
      head += bytes_.substr(appended, close + 1 - appended);
      if (head[head.size() - 2] != '/') head += "</AppendedData>";
      head += "</VTKFile>";
      const std::size_t mark = bytes_.find('_', close);
      if (mark != std::string_view::npos) data_ = bytes_.substr(mark + 1);
    }
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), &XML_ParserFree);
    Listener listener(image_, kind_, parser.get());
    XML_SetUserData(parser.get(), &listener);
    XML_SetElementHandler(parser.get(), starts, ends);
    XML_SetCharacterDataHandler(parser.get(), says);
    for (std::size_t at = 0; at <= head.size();) {
      constexpr std::size_t piece = std::size_t{1} << 24;
      const std::size_t size = std::min(piece, head.size() - at);
      const bool last = at + size == head.size();
      if (XML_Parse(parser.get(), head.data() + at, static_cast<int>(size), last ? 1 : 0) == XML_STATUS_ERROR)
        throw Error{Error::Kind::settings,
                    fmt::format("is no XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))),
                    fmt::format("{}:{}", path_, XML_GetCurrentLineNumber(parser.get())),
                    {}};
      if (last) break;
      at += size;
    }
  }

  template <std::size_t n>
  std::array<double, n> numbers(std::string_view key, std::array<double, n> otherwise) const {
    const std::string text(of(image_.image, key));
    if (text.empty()) return otherwise;
    Words words(text, path_);
    for (double& each : otherwise) {
      const std::string_view w = words.word();
      const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), each);
      if (error != std::errc{} || end != w.data() + w.size() || !std::isfinite(each))
        refuse(fmt::format("{} = '{}' is not {} numbers", key, text, n));
    }
    return otherwise;
  }

  void take_shape(Lattice& out) const {
    const auto extent = numbers<6>("WholeExtent", {0, 0, 0, 0, 0, 0});
    out.from = numbers<3>("Origin", {0, 0, 0}), out.step = numbers<3>("Spacing", {1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(out.step[i] > 0)) refuse(fmt::format("a spacing of {} mm", out.step[i]));
      out.size[i] = extent[2 * i + 1] - extent[2 * i] + (image_.on_cells ? 0 : 1);
      if (image_.on_cells) out.size[i] = std::max(out.size[i], 1.0);
      // what cells have stands in their middle
      out.from[i] += out.step[i] * (extent[2 * i] + (image_.on_cells && extent[2 * i + 1] > extent[2 * i] ? 0.5 : 0));
    }
    const std::string_view n = of(image_.array, "NumberOfComponents");
    out.components = n == "9" ? 9 : n == "6" ? 6 : n == "3" ? 3 : 1;
  }

  void take_values(Lattice& out) const {
    const std::string_view format = of(image_.array, "format");
    if (format == "ascii") return take_text(out);
    const std::string_view type = of(image_.array, "type");
    const auto row = std::find_if(type_rows.begin(), type_rows.end(), [&](const TypeRow& r) { return r.name == type; });
    if (row == type_rows.end()) refuse(fmt::format("values of type '{}'", type), "write them as Float32 or Float64");
    const std::size_t count = out.count() * out.components;
    const std::string data = bytes_of(format, count * row->bytes);
    if (data.size() < count * row->bytes) refuse(out.expected(data.size() / row->bytes / out.components));
    const bool big = of(image_.file, "byte_order") == "BigEndian";
    out.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t bits = 0;
      for (std::size_t b = 0; b < row->bytes; ++b) {
        const auto byte = static_cast<std::uint8_t>(data[i * row->bytes + (big ? b : row->bytes - 1 - b)]);
        bits = bits << 8U | byte;
      }
      out.values.push_back(static_cast<float>(row->value(bits)));
    }
  }

  void take_text(Lattice& out) const {
    Words words(image_.text, path_);
    const std::size_t count = out.count() * out.components;
    if (image_.text.size() / 2 + 1 < count) refuse(out.expected(words.left() / out.components));
    out.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view w = words.word();
      if (w.empty()) refuse(out.expected(i / out.components));
      double v = 0;
      const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), v);
      if (error != std::errc{} || end != w.data() + w.size()) refuse(fmt::format("'{}' is not a number", w));
      out.values.push_back(static_cast<float>(v));
    }
  }

  /// The array's bytes, or as many of them as there are.
  std::string bytes_of(std::string_view format, std::size_t wanted) const {
    const Packing packing{of(image_.file, "header_type") == "UInt64", of(image_.file, "byte_order") == "BigEndian",
                          !of(image_.file, "compressor").empty()};
    if (packing.compressed && of(image_.file, "compressor") != "vtkZLibDataCompressor")
      refuse(fmt::format("is compressed by {}", of(image_.file, "compressor")), "use vtkZLibDataCompressor, or none");
    if (format == "binary") return unpacked(from_base64(image_.text), packing, wanted, path_);
    if (format != "appended") refuse(fmt::format("an array of format '{}'", format), "write ascii, binary or appended");
    std::size_t offset = 0;
    const std::string_view text = of(image_.array, "offset");
    if (std::from_chars(text.data(), text.data() + text.size(), offset).ec != std::errc{} || offset > data_.size())
      refuse(fmt::format("an array at offset '{}'", text));
    const std::string_view here = data_.substr(offset);
    if (image_.appended == "raw") return unpacked(here, packing, wanted, path_);
    return unpacked(from_base64(here), packing, wanted, path_);
  }

  std::string_view bytes_, data_;
  const std::string& path_;
  Kind kind_;
  Image image_;
};

}  // namespace

Lattice read_vti(std::string_view bytes, const std::string& path, Kind kind) {
  return Reader(bytes, path, kind).read();
}

}  // namespace weft::field
