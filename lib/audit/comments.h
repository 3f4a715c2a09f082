// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft::audit {

/// What the comments of a slicer say about the moves that follow. Understands PrusaSlicer, SuperSlicer, Slic3r,
/// OrcaSlicer, Bambu Studio, Cura, ideaMaker, Simplify3D and weft.
class Context {
 public:
  Context();

  /// A comment that stands alone on its line, without its semicolon.
  void read(std::string_view comment);

  /// A sign outside of the comments that the start G-code is over.
  void begin() { began_ = true; }

  /// weft's name of a slicer's feature ("outer_wall"), or the slicer's own where weft has none; "" before the first.
  std::string_view feature() const { return names_[feature_]; }
  std::uint8_t feature_index() const { return feature_; }
  std::string_view feature_name(std::uint8_t index) const { return names_[index]; }

  /// Start, end and other G-code that a person wrote: said by a comment, or outside of the first and last layer.
  bool custom() const { return !began_ || ended_ || feature_ == custom_index; }
  /// Has any comment told where the print begins? Files without a slicer's comments never do.
  bool began() const { return began_; }

  int layer() const { return layer_; }             ///< from 0; −1 before the first
  double width_mm() const { return width_mm_; }    ///< 0 when not said
  double height_mm() const { return height_mm_; }  ///< 0 when not said
  /// What is said first of a layer: beads of some features are higher. 0 when nothing is.
  double layer_height_mm() const { return layer_height_mm_; }
  std::string_view object() const { return object_; }
  /// The label of one copy of it: what tells owners of beads apart.
  std::string_view owner() const { return owner_; }
  /// Do labels name meshes, which may be parts of one object?
  bool labels_meshes() const { return labels_meshes_; }
  void set_object(std::string_view name) { set_object(name, name); }

 private:
  static constexpr std::uint8_t custom_index = 1;
  static constexpr std::size_t most_name = 60, most_names = 64, most_label = 250;
  void set_object(std::string_view name, std::string_view label) {
    object_.assign(name.substr(0, most_name));
    owner_.assign(label.substr(0, most_label));
  }
  void set_feature(std::string_view slicers_name);
  void next_layer(int number);
  // What the signs in comments mean; see read().
  void layer_named(std::string_view number);
  void one_layer_on(std::string_view);
  void layer_at_height(std::string_view rest);
  void count_layers(std::string_view number);
  void layer_done(std::string_view);
  void end(std::string_view);
  void set_width(std::string_view length);
  void set_height(std::string_view length);
  void brim(std::string_view rest);
  void overhang(std::string_view rest);
  void mesh(std::string_view name);
  void printing_object(std::string_view rest);
  void no_object(std::string_view);

  std::vector<std::string> names_;
  std::uint8_t feature_ = 0;
  bool began_ = false, ended_ = false;
  int layer_ = -1, layer_count_ = 0;
  double width_mm_ = 0, height_mm_ = 0, layer_height_mm_ = 0;
  std::string object_, owner_;
  bool labels_meshes_ = false;
};

}  // namespace weft::audit
