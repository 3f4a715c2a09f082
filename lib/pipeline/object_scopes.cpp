// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/object_scopes.h"

#include "core/error.h"
#include "geometry/boolean.h"
#include "infill/density.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

void check_heights(const Object& object, const ObjectScopes& runs, const Scopes& scopes) {
  for (const auto& run : runs)
    for (const ScopeId id : run.of_mix) {
      const Um height = scopes[id].layers.layer_height, nozzle = scopes[id].machine.nozzle_diameter;
      if (height > nozzle)
        throw Error{Error::Kind::settings,
                    fmt::format("object '{}': layer_height {} mm is more than nozzle_diameter {} mm", object.name,
                                to_mm(height), to_mm(nozzle)),
                    {},
                    "a bead cannot be higher than the nozzle is wide"};
    }
}

/// What the closed and bridged gaps of two cuts of a layer are together.
slice::Gaps both(const slice::Gaps& a, const slice::Gaps& b) {
  auto out = b.widest_um > a.widest_um ? b : a;
  out.count = a.count + b.count;
  return out;
}

}  // namespace

ObjectScopes scopes_of(const Object& object, ToolScopes& tools, Scopes& scopes) {
  const auto lowest = [&](ScopeId id) {
    const bool raft = scopes[id].adhesion.adhesion_type == AdhesionType::raft;
    return raft ? scopes.on_raft(id) : scopes.on_first_layer(id);
  };
  const auto mixes = mixes_of(object);
  ObjectScopes out;
  for (const Um bottom : heights_of_change(object)) {
    ScopesFrom run{bottom, {}}, first{0, {}};
    for (const auto& mix : mixes) {
      const auto overlays = overlays_at(object, object.volumes[mix.part], bottom, mix.modifiers);
      run.of_mix.push_back(tools.area(object, overlays, scopes));
      if (bottom == 0) first.of_mix.push_back(tools.lowest(run.of_mix.back(), lowest));
    }
    if (bottom == 0) {  // whatever lies a micron higher is no first layer
      out.push_back(std::move(first));
      run.bottom = 1;
    }
    out.push_back(std::move(run));
  }
  check_heights(object, out, scopes);
  return out;
}

const ScopesFrom& at(const ObjectScopes& scopes, Um bottom) {
  const auto above =
      std::upper_bound(scopes.begin(), scopes.end(), bottom, [](Um b, const ScopesFrom& s) { return b < s.bottom; });
  return above == scopes.begin() ? scopes.front() : *std::prev(above);
}

std::vector<Areas> areas_of_one(const ObjectScopes& scopes, const std::vector<slice::Cut>& cuts) {
  std::vector<Areas> out;
  out.reserve(cuts.size());
  for (const auto& cut : cuts)
    out.push_back({{at(scopes, cut.layer.z - cut.layer.height).of_mix.front(),
                    static_cast<std::uint32_t>(cut.layer.regions.size())}});
  return out;
}

namespace {

/// What of a piece has other sparse infill.
struct InnerPiece {
  std::size_t mix = 0;
  ScopeId scope = 0;
  Regions regions;
};

/// Regions of a layer that are of one mix.
struct Piece {
  std::size_t mix = 0;
  ScopeId scope = 0;
  Regions regions;
  std::vector<InnerPiece> inner{};
};

bool modifies(VolumeKind kind) {
  return kind == VolumeKind::modifier || kind == VolumeKind::tint;
}

/// Does a modifier speak of sparse infill, and of nothing else?
bool of_infill(const Volume& volume) {
  return volume.kind == VolumeKind::modifier && volume.said.empty() && !volume.overlay.empty() &&
         std::all_of(volume.overlay.values.begin(), volume.overlay.values.end(),
                     [](const Laid& laid) { return laid.row->section == "infill"; });
}

/// How the volumes of an object make its layers.
class Union {
 public:
  Union(const Object& object, const ObjectScopes& scopes) : object_(object), scopes_(scopes), mixes_(mixes_of(object)) {
    modified_ = std::any_of(object.volumes.begin(), object.volumes.end(),
                            [](const Volume& volume) { return modifies(volume.kind); });
  }

  /// @param cuts of one layer, beside the volumes; null above a volume
  std::vector<Piece> pieces(Um bottom, const std::vector<const slice::Cut*>& cuts) const {
    const auto& scopes = at(scopes_, bottom).of_mix;
    std::vector<Piece> out;
    for (std::size_t v = 0, part = 0; v < cuts.size(); ++v) {
      const auto kind = object_.volumes[v].kind;
      const std::size_t mix = part;
      if (kind == VolumeKind::model) ++part;
      if (!cuts[v]) continue;
      if (kind == VolumeKind::model) add(mix, scopes[mix], cuts[v]->layer.regions, out);
      if (kind == VolumeKind::negative)
        for (auto& piece : out) piece.regions = geometry::subtract(piece.regions, cuts[v]->layer.regions);
    }
    for (std::size_t v = 0; v < cuts.size(); ++v)
      if (modifies(object_.volumes[v].kind) && cuts[v] && !of_infill(object_.volumes[v]))
        modify(v, cuts[v]->layer.regions, scopes, out);
    for (std::size_t v = 0; v < cuts.size(); ++v)
      if (cuts[v] && of_infill(object_.volumes[v]))
        for (auto& piece : out) nest(v, cuts[v]->layer.regions, scopes, piece);
    if (modified_) join(out);
    const auto nothing = [](const Piece& piece) { return piece.regions.empty(); };
    if (std::all_of(out.begin(), out.end(), nothing)) out.resize(std::min<std::size_t>(out.size(), 1));
    if (out.size() > 1) std::erase_if(out, nothing);
    return out;
  }

 private:
  /// Where it overlaps others it has it. Parts of one scope are one, unless modifiers may tell them apart.
  void add(std::size_t mix, ScopeId scope, const Regions& regions, std::vector<Piece>& to) const {
    const auto one = [&](const Piece& other) { return other.scope == scope && !(modified_ && told(other.mix, mix)); };
    for (auto& other : to)
      if (!one(other)) other.regions = geometry::subtract(other.regions, regions);
    const auto same = std::find_if(to.begin(), to.end(), one);
    if (same == to.end())
      to.push_back({mix, scope, regions});
    else
      same->regions = geometry::unite(same->regions, regions);
  }
  /// May modifiers make of two parts what is not the same?
  bool told(std::size_t a, std::size_t b) const {
    const auto &x = object_.volumes[mixes_[a].part], &y = object_.volumes[mixes_[b].part];
    if (!x.said.empty() || !y.said.empty()) return true;
    for (const auto& mix : mixes_)  // of a part alone none is known where their boxes are apart
      for (const std::size_t other : {a, b})
        if (!mix.modifiers.empty() && mix.part == mixes_[other].part &&
            !index_of({mixes_[other == a ? b : a].part, mix.modifiers}))
          return true;
    return false;
  }
  std::optional<std::size_t> index_of(const Mix& mix) const {
    const auto found = std::find(mixes_.begin(), mixes_.end(), mix);
    return found == mixes_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - mixes_.begin()));
  }
  /// The mix with one more modifier.
  std::optional<std::size_t> with(std::size_t mix, std::size_t modifier) const {
    Mix out = mixes_[mix];
    out.modifiers.insert(std::upper_bound(out.modifiers.begin(), out.modifiers.end(), modifier), modifier);
    return index_of(out);
  }
  void modify(std::size_t modifier, const Regions& by, const std::vector<ScopeId>& scopes,
              std::vector<Piece>& pieces) const {
    if (by.empty()) return;
    for (std::size_t i = 0, before = pieces.size(); i < before; ++i) divide(i, modifier, by, scopes, pieces);
  }
  void divide(std::size_t i, std::size_t modifier, const Regions& by, const std::vector<ScopeId>& scopes,
              std::vector<Piece>& pieces) const {
    const auto index = with(pieces[i].mix, modifier);
    if (!index) return;
    // Where it changes nothing it divides nothing, unless what is said of it by name may hold over another's.
    if (scopes[*index] == pieces[i].scope && object_.volumes[modifier].said.empty()) return;
    auto [inside, outside] = geometry::cut(pieces[i].regions, by);
    if (inside.empty()) return;
    pieces[i].regions = std::move(outside);
    pieces.push_back({*index, scopes[*index], std::move(inside)});
  }
  /// Walls and skins of a piece run through.
  void nest(std::size_t modifier, const Regions& by, const std::vector<ScopeId>& scopes, Piece& piece) const {
    std::vector<InnerPiece> found;
    Regions own = piece.regions;  // what of it has no other infill yet
    const auto take = [&](std::size_t mix, Regions& from) {
      const auto index = with(mix, modifier);
      if (!index) return;
      Regions inside = geometry::intersect(from, by);
      if (inside.empty()) return;
      from = geometry::subtract(from, by);
      found.push_back({*index, scopes[*index], std::move(inside)});
    };
    for (auto& inner : piece.inner) {
      own = geometry::subtract(own, inner.regions);
      take(inner.mix, inner.regions);
    }
    take(piece.mix, own);
    std::move(found.begin(), found.end(), std::back_inserter(piece.inner));
    std::erase_if(piece.inner, [&](const auto& inner) { return inner.regions.empty() || inner.scope == piece.scope; });
  }
  /// No two of one scope.
  static void join(std::vector<Piece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = pieces.size(); --k > i;)
        if (pieces[k].scope == pieces[i].scope) {
          pieces[i].regions = geometry::unite(pieces[i].regions, pieces[k].regions);
          std::move(pieces[k].inner.begin(), pieces[k].inner.end(), std::back_inserter(pieces[i].inner));
          pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
        }
  }

  const Object& object_;
  const ObjectScopes& scopes_;
  std::vector<Mix> mixes_;
  bool modified_ = false;
};

}  // namespace

std::vector<slice::Cut> united(const Object& object, const ObjectScopes& scopes,
                               const std::vector<const std::vector<slice::Cut>*>& cuts, std::vector<Areas>& areas) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < cuts.size(); ++v)
    if (object.volumes[v].kind == VolumeKind::model) count = std::max(count, cuts[v]->size());
  const Union whole(object, scopes);
  struct Layer {
    slice::Cut cut;
    Areas areas;
  };
  auto layers = tasks::parallel_map(count, [&](std::size_t i) {
    Layer out;
    std::vector<const slice::Cut*> own;
    for (std::size_t v = 0; v < cuts.size(); ++v) {
      own.push_back(i < cuts[v]->size() ? &(*cuts[v])[i] : nullptr);
      if (!own.back() || object.volumes[v].kind != VolumeKind::model) continue;
      const auto& cut = *own.back();
      out.cut.layer.z = cut.layer.z, out.cut.layer.height = cut.layer.height;
      out.cut.closed = both(out.cut.closed, cut.closed), out.cut.bridged = both(out.cut.bridged, cut.bridged);
    }
    for (auto& piece : whole.pieces(out.cut.layer.z - out.cut.layer.height, own)) {
      Area& area = out.areas.emplace_back(Area{piece.scope, static_cast<std::uint32_t>(piece.regions.size())});
      for (auto& inner : piece.inner) area.inner.push_back({inner.scope, std::move(inner.regions)});
      std::move(piece.regions.begin(), piece.regions.end(), std::back_inserter(out.cut.layer.regions));
    }
    return out;
  });
  std::vector<slice::Cut> out;
  for (auto& layer : layers) {
    out.push_back(std::move(layer.cut));
    areas.push_back(std::move(layer.areas));
  }
  return out;
}

std::string files_of_infill(const Scopes& scopes, Point at, double turned_deg) {
  std::string out;
  for (ScopeId id = 0; id < scopes.size(); ++id) {
    out += infill::Density::files_of(scopes[id].infill);
    if (scopes[id].infill.infill_phase_frame == InfillFrame::plate) out += "plate";
    if (scopes[id].infill.infill_angle_frame == InfillFrame::part) out += fmt::format("turned {}", turned_deg);
  }
  return out.empty() ? out : fmt::format("{} {} {}", out, at.x, at.y);
}

}  // namespace weft::pipeline
