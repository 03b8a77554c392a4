// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/drawing.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace ridgecraft::export_ {
namespace {

struct LayerNames {
  std::string_view id;
  std::string_view title;
};

/// In the order of Layer.
constexpr std::array layer_names{LayerNames{"paint", "Colours"},
                                 LayerNames{"tab-fill", "Tabs"},
                                 LayerNames{"cut", "Cut"},
                                 LayerNames{"mountain", "Mountain folds"},
                                 LayerNames{"valley", "Valley folds"},
                                 LayerNames{"tab-fold", "Tab folds"},
                                 LayerNames{"label", "Numbers"},
                                 LayerNames{"piece-name", "Piece names"},
                                 LayerNames{"mark", "Marks"},
                                 LayerNames{"tab-shadow", "Tab shadows"},
                                 LayerNames{"glue", "Glue here"},
                                 LayerNames{"picture", "Pictures"}};
static_assert(layer_names.size() == static_cast<std::size_t>(Layer::picture) + 1);

}  // namespace

std::string_view id(Layer layer) {
  return layer_names[static_cast<std::size_t>(layer)].id;
}

std::string_view title(Layer layer) {
  return layer_names[static_cast<std::size_t>(layer)].title;
}

bool has_layer(const Group& group, Layer layer) {
  const auto is_of = [layer](const auto& item) { return item.layer == layer; };
  const bool painted = !group.ground.empty() || !group.images.empty() || !group.fills.empty();
  return (layer == Layer::paint && painted) || std::ranges::any_of(group.areas, is_of) ||
         std::ranges::any_of(group.lines, is_of) || std::ranges::any_of(group.texts, is_of);
}

bool has_layer(const Drawing& page, Layer layer) {
  return std::ranges::any_of(page.groups, [&](const Group& group) { return has_layer(group, layer); });
}

namespace {

class Calibration {
 public:
  Calibration(Vec2 sheet, Vec2 measured)
      : middle_(0.5 * sheet), factor_{100.0 / measured.x, 100.0 / measured.y} {}

  void move(Vec2& p) const {
    p = middle_ + Vec2{factor_.x * (p.x - middle_.x), factor_.y * (p.y - middle_.y)};
  }
  void move(std::vector<Vec2>& points) const {
    for (Vec2& p : points) {
      move(p);
    }
  }
  void move(std::vector<std::vector<Vec2>>& polygons) const {
    for (std::vector<Vec2>& polygon : polygons) {
      move(polygon);
    }
  }
  void move(std::vector<Fill>& fills) const {
    for (Fill& fill : fills) {
      move(fill.polygons);
    }
  }

  void move(Group& group) const {
    for (Line& line : group.lines) {
      move(line.points);
    }
    for (Area& area : group.areas) {
      move(area.outline);
    }
    for (Text& text : group.texts) {
      move(text.centre);
    }
    move(group.ground);
    move(group.fills);
    for (Image& image : group.images) {
      move(image.place.low);
      move(image.place.high);
      move(image.clip);
    }
  }

 private:
  Vec2 middle_;
  Vec2 factor_;
};

}  // namespace

Drawing calibrated(Drawing page, Vec2 measured) {
  const Calibration calibration(page.size, measured);
  for (std::vector<Group>* const side : {&page.groups, &page.back}) {
    for (Group& group : *side) {
      calibration.move(group);
    }
  }
  return page;
}

}  // namespace ridgecraft::export_
