// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/calibration.hpp"

#include <vector>

namespace ridgecraft::export_ {
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
