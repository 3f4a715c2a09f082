// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/codec.h"

#include "model/model_fields.h"
#include "pipeline/stage_table.h"

#include <bit>
#include <stdexcept>
#include <type_traits>

namespace weft {

template <>
inline constexpr auto fields<slice::Gaps> = listed(&slice::Gaps::count, &slice::Gaps::widest_um, &slice::Gaps::at);
template <>
inline constexpr auto fields<slice::Cut> = listed(&slice::Cut::layer, &slice::Cut::closed, &slice::Cut::bridged);
template <>
inline constexpr auto fields<mesh::Repairs> = listed(&mesh::Repairs::degenerate, &mesh::Repairs::duplicates,
                                                     &mesh::Repairs::sheets, &mesh::Repairs::flipped,
                                                     &mesh::Repairs::inverted_shells, &mesh::Repairs::shells,
                                                     &mesh::Repairs::open_edges, &mesh::Repairs::non_manifold_edges,
                                                     &mesh::Repairs::one_sided_shells);
template <>
inline constexpr auto fields<mesh::ForeignSetting> = listed(&mesh::ForeignSetting::key, &mesh::ForeignSetting::value);
template <>
inline constexpr auto fields<mesh::Mark> = listed(&mesh::Mark::kind, &mesh::Mark::painted, &mesh::Mark::mesh,
                                                  &mesh::Mark::name, &mesh::Mark::settings, &mesh::Mark::author,
                                                  &mesh::Mark::after);
template <>
inline constexpr auto fields<mesh::Object> = listed(&mesh::Object::name, &mesh::Object::mesh, &mesh::Object::repairs,
                                                    &mesh::Object::marks, &mesh::Object::item, &mesh::Object::settings);
template <>
inline constexpr auto fields<mesh::RangeOfItem> = listed(&mesh::RangeOfItem::from, &mesh::RangeOfItem::to,
                                                         &mesh::RangeOfItem::settings);
template <>
inline constexpr auto fields<mesh::HeightAt> = listed(&mesh::HeightAt::z, &mesh::HeightAt::height);
template <>
inline constexpr auto fields<mesh::ItemOfFile> = listed(&mesh::ItemOfFile::name, &mesh::ItemOfFile::settings,
                                                        &mesh::ItemOfFile::ranges, &mesh::ItemOfFile::heights);
template <>
inline constexpr auto fields<mesh::PlateOfFile> = listed(&mesh::PlateOfFile::number, &mesh::PlateOfFile::name,
                                                         &mesh::PlateOfFile::objects);
template <>
inline constexpr auto fields<mesh::Loaded> = listed(&mesh::Loaded::path, &mesh::Loaded::format, &mesh::Loaded::sha256,
                                                    &mesh::Loaded::unit, &mesh::Loaded::triangles_in_file,
                                                    &mesh::Loaded::objects, &mesh::Loaded::notices,
                                                    &mesh::Loaded::author, &mesh::Loaded::items, &mesh::Loaded::plates);
template <>
inline constexpr auto fields<pipeline::FilledLayer> = listed(&pipeline::FilledLayer::top, &pipeline::FilledLayer::skin,
                                                             &pipeline::FilledLayer::sparse,
                                                             &pipeline::FilledLayer::beads,
                                                             &pipeline::FilledLayer::inner_beads,
                                                             &pipeline::FilledLayer::notices);

template <>
inline constexpr auto fields<pipeline::PrintedLayer> =
    listed(&pipeline::PrintedLayer::z, &pipeline::PrintedLayer::height, &pipeline::PrintedLayer::outline,
           &pipeline::PrintedLayer::skin, &pipeline::PrintedLayer::top, &pipeline::PrintedLayer::sparse,
           &pipeline::PrintedLayer::over_air, &pipeline::PrintedLayer::beads);
template <>
inline constexpr auto fields<support::Figures> = listed(&support::Figures::needed_mm2, &support::Figures::bridged_mm2,
                                                        &support::Figures::left_mm2, &support::Figures::left_at,
                                                        &support::Figures::left_to_part_mm2,
                                                        &support::Figures::contact_mm2, &support::Figures::on_part_mm2,
                                                        &support::Figures::islands, &support::Figures::tips,
                                                        &support::Figures::trunks, &support::Figures::trapped_mm3,
                                                        &support::Figures::slenderest);
template <>
inline constexpr auto fields<pipeline::Supports> = listed(&pipeline::Supports::layers, &pipeline::Supports::held,
                                                          &pipeline::Supports::figures,
                                                          &pipeline::Supports::idle_enforcers);

}  // namespace weft

namespace weft::pipeline {
namespace {

/// Writes values behind each other. One list of fields a type serves Writer, Reader and Meter, so that a field cannot
/// be written and not read.
class Writer {
 public:
  void operator()(const std::uint64_t& v) {
    constexpr std::size_t most = 10;
    if (out_.size() - size_ < most) out_.resize(2 * out_.size() + 256);
    char* at = out_.data() + size_;
    std::uint64_t rest = v;
    for (; rest >= 0x80; rest >>= 7) *at++ = static_cast<char>(rest | 0x80);
    *at++ = static_cast<char>(rest);
    size_ = static_cast<std::size_t>(at - out_.data());
  }
  void operator()(const std::int64_t& v) {
    (*this)((static_cast<std::uint64_t>(v) << 1) ^ static_cast<std::uint64_t>(v >> 63));
  }
  void operator()(const double& v) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    char bytes[8];
    for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> (8 * i));
    add({bytes, 8});
  }
  void operator()(const std::string& v) { (*this)(std::uint64_t{v.size()}), add(v); }
  void size(const std::uint64_t& n, std::size_t) { (*this)(n); }
  /// What was written, without room to spare: it may wait long.
  std::string bytes() const { return out_.substr(0, size_); }

 private:
  void add(std::string_view bytes) {
    if (out_.size() - size_ < bytes.size()) out_.resize(2 * out_.size() + bytes.size());
    bytes.copy(out_.data() + size_, bytes.size());
    size_ += bytes.size();
  }
  std::string out_;
  std::size_t size_ = 0;  // of it, what is written
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  void operator()(std::uint64_t& v) {
    if (!rest_.empty() && static_cast<unsigned char>(rest_[0]) < 0x80) {  // most are small
      v = static_cast<unsigned char>(rest_[0]);
      rest_.remove_prefix(1);
      return;
    }
    v = 0;
    for (int shift = 0;; shift += 7) {
      if (shift > 63) damaged();
      const auto byte = static_cast<unsigned char>(take(1)[0]);
      v |= std::uint64_t{byte & 0x7fu} << shift;
      if (byte < 0x80) return;
    }
  }
  void operator()(std::int64_t& v) {
    std::uint64_t folded = 0;
    (*this)(folded);
    v = static_cast<std::int64_t>(folded >> 1) ^ -static_cast<std::int64_t>(folded & 1);
  }
  void operator()(double& v) {
    const auto bytes = take(8);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 8; ++i) bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    v = std::bit_cast<double>(bits);
  }
  void operator()(std::string& v) {
    std::uint64_t n = 0;
    (*this)(n);
    v = take(n);
  }
  /// A number of items, each of which takes a byte at least.
  void size(std::uint64_t& n, std::size_t) {
    (*this)(n);
    if (n > rest_.size()) damaged();
  }
  void finish() const {
    if (!rest_.empty()) damaged();
  }

 private:
  std::string_view take(std::uint64_t n) {
    if (n > rest_.size()) damaged();
    const auto out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }
  [[noreturn]] static void damaged() { throw std::runtime_error("a cached result is damaged"); }
  std::string_view rest_;
};

/// Adds up what vectors and texts hold.
class Meter {
 public:
  void operator()(const std::uint64_t&) {}
  void operator()(const std::int64_t&) {}
  void operator()(const double&) {}
  void operator()(const std::string& v) { bytes += v.size(); }
  void size(const std::uint64_t& n, std::size_t each) { bytes += n * each; }

  std::size_t bytes = 0;
};

template <class A>
inline constexpr bool reads = std::is_same_v<A, Reader>;
/// T when it is read into, const T when it is written.
template <class A, class T>
using Ref = std::conditional_t<reads<A>, T, const T>&;

/// A vector whose items are written one by one; rings and paths have a way of their own.
template <class V>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = !std::is_same_v<T, Point> && !std::is_same_v<T, Junction>;

// walk(a, v): the value v through the writer, reader or meter a. A type with a list of its fields (core/fields.h) goes
// field by field; the other overloads are for what is written in another way.

template <class A, class T>
requires std::is_integral_v<T> || std::is_enum_v<T>
void walk(A& a, T& v) {
  using Wide = std::conditional_t<std::is_signed_v<std::remove_const_t<T>>, std::int64_t, std::uint64_t>;
  auto wide = static_cast<Wide>(v);
  a(wide);
  if constexpr (reads<A>) v = static_cast<T>(wide);
}
template <class A>
void walk(A& a, Ref<A, double> v) {
  a(v);
}
template <class A>
void walk(A& a, Ref<A, std::string> v) {
  a(v);
}
template <class A, class V>
requires is_list<std::remove_const_t<V>>
void walk(A& a, V& v) {
  auto count = std::uint64_t{v.size()};
  a.size(count, sizeof(typename V::value_type));
  if constexpr (reads<A>) v.resize(count);
  for (auto& item : v) walk(a, item);
}
template <class A, class T>
requires HasFields<T>
void walk(A& a, T& v) {
  for_each_field(v, [&](auto& field) { walk(a, field); });
}

/// A whole number as its difference from the one before, modulo 2⁶⁴: bytes that nobody wrote may hold any.
template <class A, class T>
void difference(A& a, T& v, std::int64_t& before) {
  const auto last = static_cast<std::uint64_t>(before);
  auto step = static_cast<std::int64_t>(reads<A> ? 0 : static_cast<std::uint64_t>(v) - last);
  a(step);
  before = static_cast<std::int64_t>(last + static_cast<std::uint64_t>(step));
  if constexpr (reads<A>) v = static_cast<T>(before);
}
/// A number by the bits that differ from those of the usual one, which takes one byte.
template <class A>
void unlike(A& a, Ref<A, float> v, float usual) {
  const auto base = std::bit_cast<std::uint32_t>(usual);
  auto bits = std::uint64_t{std::bit_cast<std::uint32_t>(v) ^ base};
  a(bits);
  if constexpr (reads<A>) v = std::bit_cast<float>(static_cast<std::uint32_t>(bits) ^ base);
}

template <class A>
void walk(A& a, Ref<A, float> v) {
  unlike(a, v, 0.F);
}
template <class A>
void walk(A& a, Ref<A, Ring> ring) {
  auto count = std::uint64_t{ring.size()};
  a.size(count, sizeof(Point));
  if constexpr (reads<A>) ring.resize(count);
  std::int64_t x = 0, y = 0;
  for (auto& p : ring) difference(a, p.x, x), difference(a, p.y, y);
}
template <class A>
void walk(A& a, Ref<A, std::vector<Junction>> path) {
  static_assert(field_count<Junction>() == 3, "a field of junctions is not written");
  auto count = std::uint64_t{path.size()};
  a.size(count, sizeof(Junction));
  if constexpr (reads<A>) path.resize(count);
  std::int64_t x = 0, y = 0, width = 0;
  for (auto& j : path) {
    difference(a, j.at.x, x), difference(a, j.at.y, y), difference(a, j.width, width);
    unlike(a, j.flow, 1.F);
  }
}
/// Makes a step of the kind with that index.
template <std::size_t kind = 0>
void become(Step& step, std::uint64_t index) {
  if constexpr (kind == std::variant_size_v<Step>)
    throw std::runtime_error("a cached result is damaged");
  else if (index == kind)
    step.emplace<kind>();
  else
    become<kind + 1>(step, index);
}
template <class A>
void walk(A& a, Ref<A, Step> v) {
  auto kind = std::uint64_t{v.index()};
  a(kind);
  if constexpr (reads<A>) become(v, kind);
  std::visit([&](auto& step) { walk(a, step); }, v);
}
template <class A>
void walk(A& a, Ref<A, Mesh> v) {
  static_assert(field_count<Mesh>() == 3, "a field of meshes is not written");
  walk(a, v.cut_through);
  auto count = std::uint64_t{v.vertices.size()};
  a.size(count, sizeof(Point3));
  if constexpr (reads<A>) v.vertices.resize(count);
  std::int64_t x = 0, y = 0, z = 0;
  for (auto& p : v.vertices) difference(a, p.x, x), difference(a, p.y, y), difference(a, p.z, z);
  count = v.triangles.size();
  a.size(count, sizeof(Triangle));
  if constexpr (reads<A>) v.triangles.resize(count);
  std::int64_t corner = 0;
  for (auto& t : v.triangles)
    for (auto& c : t) difference(a, c, corner);
}

}  // namespace

template <class T>
std::string encode(const T& v) {
  Writer writer;
  walk(writer, v);
  return writer.bytes();
}
template <class T>
void decode(std::string_view bytes, T& out) {
  Reader reader(bytes);
  walk(reader, out);
  reader.finish();
}
template <class T>
std::size_t memory_of(const T& v) {
  Meter meter;
  walk(meter, v);
  return meter.bytes;
}

/// What is ever kept as bytes: the results of stages, and layers that wait for theirs.
template <class T>
struct Kept {
  static constexpr auto functions = std::tuple{&encode<T>, &decode<T>, &memory_of<T>};
};
template <>
struct Kept<NotKept> {
  static constexpr std::tuple functions{};
};
template <class Table>
struct KeptOf;
template <class... Rows>
struct KeptOf<const std::tuple<Rows...>> {
  static constexpr std::tuple all{Kept<LayerPlan>::functions, Kept<typename Rows::Result>::functions...};
};
template struct KeptOf<decltype(stage_table)>;

}  // namespace weft::pipeline
