// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons over points of a coarse grid, so that all that can be wrong with a model is wrong at once:
// repaired, and made ready for paper, they keep the promises of mesh/.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "mesh/mesh.hpp"
#include "mesh/repair/repair.hpp"
#include "prepare/prepare.hpp"

namespace {

using namespace ridgecraft;

void require(bool condition) {
  if (!condition) {
    std::abort();
  }
}

/// Bytes one after the other; zeros when there are no more.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  std::uint8_t next() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
  [[nodiscard]] bool more() const { return at_ != end_; }

 private:
  const std::uint8_t* at_;
  const std::uint8_t* end_;
};

mesh::Soup soup_of(Bytes& bytes) {
  mesh::Soup soup;
  const std::size_t points = 3 + bytes.next() % 30U;
  // From a lattice of 4 to one of 256 steps, each coordinate a little off now and then.
  const unsigned coarse = bytes.next() % 7U;
  const double nudge = std::ldexp(1.0, -(bytes.next() % 48));
  for (std::size_t i = 0; i < points; ++i) {
    Vec3 p;
    for (double* x : {&p.x, &p.y, &p.z}) {
      const unsigned byte = bytes.next();
      *x = static_cast<double>(byte >> coarse) + (byte % 5U == 1U ? nudge : 0.0);
    }
    soup.points.push_back(p);
  }
  while (bytes.more() && soup.polygon_count() < 120) {
    const unsigned corners = bytes.next() % 7U;
    for (unsigned k = 0; k < corners; ++k) {
      soup.corner_point.push_back(static_cast<std::uint32_t>(bytes.next() % points));
    }
    soup.first_corner.push_back(static_cast<std::uint32_t>(soup.corner_point.size()));
  }
  return soup;
}

void check(const mesh::Model& model, std::size_t polygons) {
  require(model.surface.face_count() > 0 && model.polygon.size() == model.surface.face_count());
  require(model.polygon_count == polygons);
  for (std::uint32_t f = 0; f < model.surface.face_count(); ++f) {
    const std::uint32_t polygon = model.polygon[FaceId(f)];
    require(polygon == mesh::Soup::none || polygon < polygons);
  }
  for (const mesh::Repair& repair : model.repairs.entries()) {
    require(repair.count > 0 && !english(mesh::message(repair)).empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t how = bytes.next();
  mesh::ReadOptions options;
  options.collapse_flat_faces = how % 2U == 0;
  mesh::Soup soup = soup_of(bytes);
  const std::size_t polygons = soup.polygon_count();
  try {
    mesh::Model model = mesh::repair(std::move(soup), options, {});
    check(model, polygons);
    if (options.collapse_flat_faces) {
      prepare::SimplifyOptions simplify;
      simplify.mode = how % 4U == 0 ? prepare::Simplification::automatic : prepare::Simplification::keep;
      const prepare::Prepared prepared =
          prepare::prepare(std::move(model), {}, simplify, {{190.0, 277.0}}, {});
      require(prepared.panels.count() > 0);
      for (const Vec3 p : prepared.model.surface.points()) {
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      }
    }
  } catch (const Error& error) {
    const std::string sentence = error.what();
    require(error.kind() == ErrorKind::unusable_mesh || error.kind() == ErrorKind::no_nets);
    require(!sentence.empty() && !sentence.ends_with('.') && printable(sentence) == sentence);
  }
  return 0;
}
