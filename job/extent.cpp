// SPDX-License-Identifier: GPL-3.0-or-later
#include "job/extent.hpp"

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "export/view/camera.hpp"

namespace ridgecraft::job {
namespace {

const char* name_of(ExtentKind kind) {
  switch (kind) {
    case ExtentKind::width:
      return "width";
    case ExtentKind::depth:
      return "depth";
    case ExtentKind::height:
      break;
  }
  return "height";
}

}  // namespace

double largest_share(const mesh::Model& model, ExtentKind kind, mesh::Axis up) {
  const export_::Stance stance = export_::stance_of(up);
  const Vec3 direction = kind == ExtentKind::height  ? stance.up
                         : kind == ExtentKind::depth ? stance.front
                                                     : cross(stance.up, stance.front);
  const Box3& box = model.surface.bounds();
  const double extent = std::abs(dot(direction, box.size()));
  if (!(extent > 0.0)) {
    throw Error(ErrorKind::usage, std::string("the model is flat and has no ") + name_of(kind));
  }
  return box.largest_extent() / extent;
}

}  // namespace ridgecraft::job
