// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.h"
#include "core/stop.h"
#include "mesh/formats.h"
#include "mesh/three_mf.h"
#include "mesh/three_mf_colours.h"
#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <compare>
#include <deque>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

/// Makes the bodies of the build: each item is an object with all its components, transformed.
class Build {
 public:
  Build(const Source& source, ThreeMf document) : source_(source), document_(std::move(document)) {}

  Contents contents() {
    choose_plate();
    if (document_.items.empty())
      throw Error(Error::Kind::model, "its build holds nothing to print", source_.path, "export the model again");
    Contents contents;
    if (document_.items.size() > max_items)
      refuse(document_.items[max_items],
             fmt::format("the build has {} items, of which {} could be printed", document_.items.size(), max_items),
             "print fewer at once");
    std::size_t sum = 0;
    for (const Reference& item : document_.items) {
      sum += measure(item, 0);
      if (sum > max_triangles)
        refuse(item, fmt::format("the build asks for more than {} triangles and vertices", max_triangles));
    }
    const auto places = places_of_objects();
    std::vector<Cura> says;
    for (const Reference& item : document_.items) {
      stop_if_asked();
      says.push_back(cura_of(item));
      const auto* said = said_of(item);
      ItemOfFile what{object(item).name, said ? said->settings : says.back().settings, {}, {}};
      if (what.name.empty() && said) what.name = said->name;
      if (const auto at = places.find(item.object.second); at != places.end()) tell_heights(at->second, what);
      contents.items.push_back(std::move(what));
      const std::size_t begin = contents.bodies.size();
      auto own = copied(item, contents.bodies);
      if (own.empty()) own = bodies(item, said);
      for (auto& body : own) {
        body.item = contents.items.size() - 1;
        contents.bodies.push_back(std::move(body));
      }
      made_.push_back({&item, begin, contents.bodies.size()});
    }
    contents.unit = document_.unit;
    contents.notices = std::move(document_.notices);
    lay_beside(says, contents);
    for (const auto& part : document_.parts.unread)
      contents.notices.push_back({"project_part_left_out", fmt::format("{}: {} is not read", source_.path, part)});
    for (const auto& kind : document_.parts.unknown_kinds)
      contents.notices.push_back(
          {"project_kind_unknown",
           fmt::format("{}: weft does not know volumes of the kind '{}'; one is printed as a part", source_.path,
                       kind)});
    contents.author = document_.parts.author;
    for (const auto& plate : document_.parts.plates)
      contents.plates.push_back({plate.number, plate.name, plate.instances.size()});
    return contents;
  }

 private:
  static constexpr int deepest = 64;

  /// Of several plates that something stands on, what stands on the one that is meant.
  void choose_plate() {
    auto plates = document_.parts.plates;
    std::erase_if(plates, [](const PlateSaid& plate) { return plate.instances.empty(); });
    if (source_.plate < 0 || (plates.size() < 2 && source_.plate <= 1)) return;
    const auto wanted = [&](const PlateSaid& plate) { return plate.number == source_.plate; };
    const auto chosen = std::find_if(plates.begin(), plates.end(), wanted);
    if (source_.plate == 0 || chosen == plates.end())
      throw Error(Error::Kind::usage,
                  source_.plate == 0 ? fmt::format("{} plates", plates.size())
                                     : fmt::format("there is no plate {} with something on it", source_.plate),
                  source_.path,
                  plates.size() < 2 ? "it has one plate"
                                    : fmt::format("--plate {} … {}", plates.front().number, plates.back().number));
    std::map<std::uint32_t, std::uint32_t> seen;  // copies of each object so far
    std::erase_if(document_.items, [&](const Reference& item) {
      const std::pair instance(item.object.second, seen[item.object.second]++);
      return std::find(chosen->instances.begin(), chosen->instances.end(), instance) == chosen->instances.end();
    });
  }

  /// The bodies of an item that stands there already, moved by whole microns, where this one is a copy of it: they are
  /// equal then, and printed as copies. Nothing: it is none.
  std::vector<Body> copied(const Reference& item, const std::vector<Body>& all) const {
    const auto same = std::find_if(made_.begin(), made_.end(), [&](const Made& made) {
      return made.item->object == item.object && made.item->transform.linear() == item.transform.linear();
    });
    if (same == made_.end()) return {};
    const Eigen::Vector3d by =
        (item.transform.translation() - same->item->transform.translation()) * document_.mm_per_unit * source_.scale;
    for (const double mm : by)
      if (!placeable(mm)) return {};  // which is told where it is read
    const Point3 um{lattice(by.x()), lattice(by.y()), lattice(by.z())};
    std::vector<Body> out(all.begin() + static_cast<std::ptrdiff_t>(same->begin),
                          all.begin() + static_cast<std::ptrdiff_t>(same->end));
    for (auto& body : out) {
      move(body.mesh, um);
      for (auto& mark : body.marks) move(mark.mesh, um);
    }
    for (const auto& body : out)
      for (const Point3 p : body.mesh.vertices)
        if (!placeable(to_mm(p.x)) || !placeable(to_mm(p.y)) || !placeable(to_mm(p.z))) return {};
    return out;
  }
  static void move(Mesh& mesh, Point3 by) {
    for (Point3& p : mesh.vertices) p = {p.x + by.x, p.y + by.y, p.z + by.z};
  }

  const Resource& object(const Reference& reference) const {
    const auto at = document_.objects.find(reference.object);
    if (at == document_.objects.end()) refuse(reference, fmt::format("there is no object {}", reference.object.second));
    return at->second;
  }

  /// Triangles, vertices and components of the object, multiplied out; at most max_triangles + 1 of them. What is made
  /// of copies of copies is counted once, or counting would take as long as the copies themselves.
  std::size_t measure(const Reference& reference, int depth) {
    if (depth > deepest) refuse(reference, "components within components without end");
    if (const auto known = sizes_.find(reference.object); known != sizes_.end()) return known->second;
    const Resource& resource = object(reference);
    std::size_t size = resource.triangles.size() + resource.vertices.size() + 1;
    for (const Reference& component : resource.components)
      size = std::min(size + measure(component, depth + 1), max_triangles + 1);
    return sizes_[reference.object] = size;
  }

  /// What is said of an item's object; of what is a copy of another, what is said of that.
  const ObjectSaid* said_of(const Reference& item) const {
    const Reference* at = &item;
    for (int depth = 0; depth < deepest; ++depth) {
      if (at->object.first != document_.root) return nullptr;
      if (const auto* said = document_.parts.of(at->object.second)) return said;
      const auto& components = object(*at).components;
      if (components.size() != 1) return nullptr;
      at = &components.front();
    }
    return nullptr;
  }

  /// Ranges of heights go by the place of an object among those that something is said of; where nothing is said of
  /// any, among those that are printed.
  std::map<std::uint32_t, std::uint32_t> places_of_objects() const {
    std::map<std::uint32_t, std::uint32_t> out;
    std::set<std::uint32_t> printed;
    for (const Reference& item : document_.items)
      if (item.object.first == document_.root) printed.insert(item.object.second);
    const bool is_said = !document_.parts.objects.empty();
    std::uint32_t place = 0;
    for (const auto& [key, resource] : document_.objects)
      if (key.first == document_.root &&
          (is_said ? document_.parts.of(key.second) != nullptr : printed.count(key.second) > 0))
        out[key.second] = ++place;
    return out;
  }

  void tell_heights(std::uint32_t place, ItemOfFile& what) const {
    const auto& parts = document_.parts;
    if (const auto ranges = parts.ranges.find(place); ranges != parts.ranges.end()) what.ranges = ranges->second;
    if (const auto heights = parts.heights.find(place); heights != parts.heights.end()) what.heights = heights->second;
  }

  /// Are the item's parts kept apart? Where one has settings of its own, or a negative volume cuts some of them only.
  static bool keeps_parts(const ObjectSaid* said) {
    if (!said) return false;
    std::vector<const VolumeSaid*> volumes;
    for (const auto& volume : said->volumes) volumes.push_back(&volume);
    for (const auto& [component, volume] : said->components) volumes.push_back(&volume);
    const auto is_part = [](const VolumeSaid* volume) { return !volume->kind; };
    if (std::count_if(volumes.begin(), volumes.end(), is_part) < 2) return false;
    return std::any_of(volumes.begin(), volumes.end(), [&](const VolumeSaid* volume) {
      if (is_part(volume)) return !volume->settings.empty();
      return volume->kind == MarkKind::negative &&
             std::any_of(volumes.begin(), volumes.end(),
                         [&](const VolumeSaid* other) { return is_part(other) && other->number > volume->number; });
    });
  }

  std::vector<Body> bodies(const Reference& item, const ObjectSaid* said) {
    marks_.clear(), parts_.clear();
    apart_ = keeps_parts(said);
    if (!apart_) parts_.push_back({nullptr, Weld(sizes_[item.object] / 2), {}});
    add(item, Eigen::Affine3d(Eigen::Scaling(document_.mm_per_unit * source_.scale)), {});
    if (parts_.empty()) parts_.push_back({nullptr, Weld(64), {}});
    std::sort(parts_.begin(), parts_.end(),
              [](const PartInWork& a, const PartInWork& b) { return a.number() < b.number(); });
    std::vector<Body> out;
    for (auto& part : parts_) {
      const auto& named = object(item).name;
      out.push_back(
          {named.empty() && said ? said->name : named, {part.weld.take_vertices(), std::move(part.triangles)}});
      if (!part.volume) continue;
      if (!part.volume->name.empty()) out.back().name = part.volume->name;
      out.back().settings = part.volume->settings;
    }
    for (auto& [key, mark] : marks_) {
      Mark made{key.kind, key.painted, {mark.weld.take_vertices(), std::move(mark.triangles)}};
      drop_degenerate(made.mesh);
      if (key.kind == MarkKind::tint) made.settings = {mark.tint}, made.author = document_.parts.author;
      made.name = mark.name;
      if (mark.volume) {
        made.name = mark.volume->name;
        made.settings = mark.volume->settings, made.author = document_.parts.author;
        const auto before = std::count_if(parts_.begin(), parts_.end(), [volume = mark.volume](const PartInWork& part) {
          return part.number() < volume->number;
        });
        if (apart_ && key.kind == MarkKind::negative) made.after = static_cast<std::size_t>(before);
      }
      out.front().marks.push_back(std::move(made));
    }
    return out;
  }

  /// What Cura says of an item: settings, and whether it is no part of the print.
  struct Cura {
    std::optional<MarkKind> kind{};
    std::vector<ForeignSetting> settings{};
  };
  Cura cura_of(const Reference& item) const {
    struct Row {
      std::string_view key;
      MarkKind kind;
    };
    constexpr std::array rows{Row{"infill_mesh", MarkKind::modifier}, Row{"cutting_mesh", MarkKind::modifier},
                              Row{"support_mesh", MarkKind::support},
                              Row{"anti_overhang_mesh", MarkKind::support_blocker}};
    constexpr std::array<std::string_view, 6> of_the_scene{"drop_to_buildplate", "print_order", "mesh_order",
                                                           "infill_mesh_order",  "infill_mesh", "cutting_mesh"};
    Cura out;
    for (const auto& setting : object(item).settings) {
      const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.key == setting.key; });
      const bool on = setting.value == "True" || setting.value == "true";
      if (row != rows.end() && on) out.kind = row->kind;
      if (row == rows.end() && std::find(of_the_scene.begin(), of_the_scene.end(), setting.key) == of_the_scene.end())
        out.settings.push_back(setting);
    }
    return out;
  }

  /// Cura's meshes that modify or mark lie beside the others: what is meant is whatever they meet, in plan.
  static void lay_beside(const std::vector<Cura>& says, Contents& contents) {
    std::vector<Body> marks;
    std::vector<Box> items(contents.items.size());
    for (auto& body : contents.bodies)
      if (says[body.item].kind)
        marks.push_back(std::move(body));
      else
        items[body.item].add(plan_of(body.mesh));
    std::erase_if(contents.bodies, [&](const Body& body) { return says[body.item].kind.has_value(); });
    for (const auto& mark : marks) {
      const auto& cura = says[mark.item];
      const Box box = plan_of(mark.mesh);
      bool met = false;
      for (std::size_t i = 0; i < contents.bodies.size(); ++i) {
        auto& body = contents.bodies[i];
        if ((i > 0 && contents.bodies[i - 1].item == body.item) || !box.overlaps(items[body.item])) continue;
        body.marks.push_back({*cura.kind, false, mark.mesh, mark.name, cura.settings, Author::cura});
        met = true;
      }
      if (!met)
        contents.notices.push_back({"project_part_left_out", fmt::format("'{}' changes other models where it meets "
                                                                         "them: it meets none and is left out",
                                                                         mark.name)});
    }
  }
  static Box plan_of(const Mesh& mesh) {
    Box out;
    for (const auto& p : mesh.vertices) out.add(Point{p.x, p.y});
    return out;
  }

  /// Corners of a triangle as they are wound in a mirrored object, too.
  static Triangle wound(const Triangle& t, bool mirrored) { return {t[0], t[mirrored ? 2 : 1], t[mirrored ? 1 : 2]}; }

  Point3 placed(const Eigen::Vector3d& mm, const Reference& reference, std::size_t vertex) const {
    for (const double c : mm)
      if (!placeable(c))
        refuse(reference,
               fmt::format("object {}, vertex {}: a coordinate {}", reference.object.second, vertex, fault_of(c)),
               "check the unit and --scale");
    return {lattice(mm.x()), lattice(mm.y()), lattice(mm.z())};
  }

  /// What becomes of triangles: part of the item where it has no kind.
  struct Belongs {
    const VolumeSaid* volume = nullptr;
    std::optional<MarkKind> kind{};
  };
  struct PartInWork {
    const VolumeSaid* volume;
    Weld weld;
    std::vector<Triangle> triangles;
    std::size_t number() const { return volume ? volume->number : 0; }
  };
  /// One mesh a kind, and of those that modify or cut one a volume: what it holds may overlap.
  struct MarkKey {
    MarkKind kind;
    bool painted = false;
    std::size_t volume = 0;
    auto operator<=>(const MarkKey&) const = default;
  };
  struct MarkInWork {
    Weld weld{64};
    std::vector<Triangle> triangles;
    const VolumeSaid* volume = nullptr;
    ForeignSetting tint{};  ///< of what is for another extruder
    std::string name{};     ///< of the volume, or of all of them
  };

  void mark(const Resource& resource, const Eigen::Affine3d& transform, const Reference& reference,
            const Belongs& belongs, std::size_t t, bool mirrored) {
    const bool by_volume = *belongs.kind == MarkKind::modifier || *belongs.kind == MarkKind::negative;
    auto& to = marks_[{*belongs.kind, false, by_volume && belongs.volume ? belongs.volume->number : 0}];
    if (by_volume) to.volume = belongs.volume;
    if (belongs.volume && to.name.find(belongs.volume->name) == std::string::npos)
      to.name += (to.name.empty() ? "" : ", ") + belongs.volume->name;
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto v = resource.triangles[t][i];
      corners[i] = to.weld.index(placed(transform * resource.vertices[v], reference, v));
    }
    to.triangles.push_back(wound(corners, mirrored));
  }
  void paint(const Resource& resource, const Eigen::Affine3d& transform, const Reference& reference, bool mirrored) {
    const auto add = [&](MarkInWork& to, const auto& corners) {
      Triangle triangle;
      for (std::size_t i = 0; i < 3; ++i) triangle[i] = to.weld.index(placed(transform * corners[i], reference, 0));
      to.triangles.push_back(wound(triangle, mirrored));
    };
    for (const auto& facet : resource.painted)
      add(marks_[{facet.paint == Paint::enforcer ? MarkKind::support_enforcer : MarkKind::support_blocker, true, 0}],
          facet.corners);
    for (const auto& facet : resource.tinted) {
      auto& to = marks_[{MarkKind::tint, true, static_cast<std::size_t>(facet.state)}];
      to.tint = {"extruder", std::to_string(facet.state)};
      add(to, facet.corners);
    }
    constexpr std::size_t colours = std::size_t{1} << 24;  // behind all extruders
    for (const auto& [t, colour] : resource.coloured) {
      const auto number = static_cast<std::size_t>(colour.r << 16 | colour.g << 8 | colour.b);
      auto& to = marks_[{MarkKind::tint, true, colours + number}];
      to.tint = {std::string(colour_key), text_of(colour)};
      const auto& [a, b, c] = resource.triangles[t];
      add(to, std::array{resource.vertices[a], resource.vertices[b], resource.vertices[c]});
    }
  }

  PartInWork& part_of(const VolumeSaid* volume) {
    if (!apart_) volume = nullptr;
    for (auto& part : parts_)
      if (part.volume == volume) return part;
    return parts_.emplace_back(PartInWork{volume, Weld(64), {}});
  }

  bool is_divided(const ObjectSaid& said) const {
    return !said.volumes.empty() &&
           (apart_ || std::any_of(said.volumes.begin(), said.volumes.end(),
                                  [](const VolumeSaid& volume) { return volume.kind.has_value(); }));
  }

  /// @param belongs what all of it is, where it is said
  void add(const Reference& reference, const Eigen::Affine3d& outer, Belongs belongs) {
    const Resource& resource = object(reference);
    if (resource.type == "support" || resource.type == "solidsupport") {
      if (!belongs.kind) belongs = {nullptr, MarkKind::support};
    } else if (resource.type != "model" && resource.type != "surface") {
      document_.notices.push_back(
          {"mesh_object_left_out", fmt::format("{}: object {} is of type '{}' and was left out", reference.where,
                                               reference.object.second, resource.type)});
      return;
    }
    const Eigen::Affine3d transform = outer * reference.transform;
    const bool mirrored = transform.linear().determinant() < 0;
    const auto& [part, number] = reference.object;
    const auto& said = document_.parts;
    const bool in_root = part == document_.root;
    const bool divided = in_root && !belongs.kind && said.of(number) && is_divided(*said.of(number));
    std::vector<std::uint32_t> welded(resource.vertices.size(), unwelded);
    PartInWork* last = nullptr;  // that corners were welded in
    const auto corner = [&](PartInWork& to, std::uint32_t v) {
      if (&to != last) std::fill(welded.begin(), welded.end(), unwelded), last = &to;
      if (welded[v] == unwelded) welded[v] = to.weld.index(placed(transform * resource.vertices[v], reference, v));
      return welded[v];
    };
    if (!belongs.kind && !divided && !resource.vertices.empty())
      for (std::uint32_t v = 0; v < welded.size(); ++v) corner(part_of(belongs.volume), v);
    for (std::size_t t = 0; t < resource.triangles.size(); ++t) {
      Belongs own = belongs;
      if (divided)
        if (const auto* volume = said.of_triangle(number, t)) own = {volume, volume->kind};
      if (own.kind) {
        mark(resource, transform, reference, own, t, mirrored);
        continue;
      }
      auto& to = part_of(own.volume);
      const auto& [a, b, c] = resource.triangles[t];
      const std::uint32_t i = corner(to, a), j = corner(to, b), k = corner(to, c);
      to.triangles.push_back(wound({i, j, k}, mirrored));
    }
    if (!belongs.kind) paint(resource, transform, reference, mirrored);
    for (const Reference& component : resource.components) {
      const auto* volume = in_root && !belongs.kind ? said.of_component(number, component.object.second) : nullptr;
      add(component, transform, volume ? Belongs{volume, volume->kind} : belongs);
    }
  }

  [[noreturn]] static void refuse(const Reference& reference, std::string what,
                                  std::string hint = "export the model again") {
    throw Error(Error::Kind::model, std::move(what), reference.where, std::move(hint));
  }

  const Source& source_;
  ThreeMf document_;
  std::map<ObjectKey, std::size_t> sizes_;
  static constexpr std::uint32_t unwelded = ~std::uint32_t{0};
  /// An item that is made, and its bodies.
  struct Made {
    const Reference* item;
    std::size_t begin, end;
  };
  std::vector<Made> made_;
  std::map<MarkKey, MarkInWork> marks_;  ///< of the item in work
  std::deque<PartInWork> parts_;         ///< of it; references stay
  bool apart_ = false;                   ///< whether its parts are kept apart
};

}  // namespace

bool is_3mf(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04");
}

Contents read_3mf(const Source& source) {
  Archive archive(source.bytes, source.path);
  return Build(source, parse_3mf(archive, source.path)).contents();
}

}  // namespace weft::mesh
