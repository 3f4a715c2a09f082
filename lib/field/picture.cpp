// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "field/grid.h"

#include <charconv>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <png.h>

namespace weft::field {
namespace {

[[noreturn]] void refuse(const std::string& path, std::string problem, std::string hint = {}) {
  throw Error{Error::Kind::settings, std::move(problem), path, std::move(hint)};
}

Grid empty(std::size_t columns, std::size_t rows) {
  Grid out;
  out.columns = columns, out.rows = rows;
  out.x0 = out.y0 = 0.5;
  out.values.resize(columns * rows);
  return out;
}

Grid read_png(std::string_view bytes, const std::string& path) {
  png_image image;
  std::memset(&image, 0, sizeof image);
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    refuse(path, fmt::format("is no PNG that can be read: {}", image.message));
  if (std::size_t{image.width} * image.height > most_values) {
    png_image_free(&image);
    refuse(path,
           fmt::format("{} × {} pixels, {:.3g} at most", image.width, image.height, static_cast<double>(most_values)));
  }
  image.format = PNG_FORMAT_GRAY;
  Grid out = empty(image.width, image.height);
  std::vector<std::uint8_t> grey(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};  // what is transparent is white
  if (png_image_finish_read(&image, &white, grey.data(), 0, nullptr) == 0)
    refuse(path, fmt::format("is no PNG that can be read: {}", image.message));
  for (std::size_t j = 0; j < out.rows; ++j)
    for (std::size_t i = 0; i < out.columns; ++i)
      out.values[(out.rows - 1 - j) * out.columns + i] = 1.F - static_cast<float>(grey[j * out.columns + i]) / 255.F;
  return out;
}

/// Netpbm's greymap, plain (P2) or raw (P5).
class Greymap {
 public:
  Greymap(std::string_view bytes, const std::string& path) : rest_(bytes.substr(2)), path_(path) {}

  Grid read(bool plain) {
    const std::size_t columns = number(), rows = number(), most = number();
    if (columns == 0 || rows == 0 || most == 0 || most > 65535 || columns > most_values / rows)
      refuse(path_, fmt::format("{} × {} pixels of 0 … {}", columns, rows, most), "a PGM is 1 × 1 pixels or more");
    Grid out = empty(columns, rows);
    const std::size_t wide = most > 255 ? 2 : 1;
    if (!plain) {
      if (!rest_.empty()) rest_.remove_prefix(1);
      if (rest_.size() < columns * rows * wide)
        refuse(path_,
               fmt::format("{} pixels, {} ({} × {}) expected", rest_.size() / wide, columns * rows, columns, rows));
    }
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < columns; ++i) {
        const std::size_t n = j * columns + i;
        std::size_t v = 0;
        if (plain)
          v = number();
        else
          for (std::size_t b = 0; b < wide; ++b) v = v << 8U | static_cast<std::uint8_t>(rest_[n * wide + b]);
        if (v > most) refuse(path_, fmt::format("pixel {}: {} is more than {}", n, v, most));
        out.values[(rows - 1 - j) * columns + i] = 1.F - static_cast<float>(v) / static_cast<float>(most);
      }
    return out;
  }

 private:
  std::size_t number() {
    for (;;) {
      while (!rest_.empty() && (rest_.front() == ' ' || (rest_.front() >= '\t' && rest_.front() <= '\r')))
        rest_.remove_prefix(1);
      if (rest_.empty() || rest_.front() != '#') break;
      rest_.remove_prefix(std::min(rest_.size(), rest_.find('\n')));
    }
    std::size_t v = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), v);
    if (error != std::errc{}) refuse(path_, "ends, or holds no number, where one is expected");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return v;
  }

  std::string_view rest_;
  const std::string& path_;
};

}  // namespace

Grid read_picture(std::string_view bytes, const std::string& path) {
  if (bytes.starts_with("\x89PNG")) return read_png(bytes, path);
  if (bytes.starts_with("P5") || bytes.starts_with("P2")) return Greymap(bytes, path).read(bytes[1] == '2');
  refuse(path, "is neither a PNG nor a PGM", "convert it to one of them");
}

}  // namespace weft::field
