// SPDX-License-Identifier: GPL-3.0-or-later
#include "prepare/shares/share_twins.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "prepare/symmetry/twins.hpp"

namespace ridgecraft::prepare {
namespace {

class TwinSharer {
 public:
  TwinSharer(SymmetricShare& share, const mesh::Surface& model) : share_(share), model_(model) {
    std::vector<std::uint32_t> count(model.component_count(), 0);
    for (const SymmetricShare::Origin& origin : share.origins) {
      const std::uint32_t body = model.component(FaceId(origin.face)).value();
      share.body.push_back(body);
      share.rank.push_back(count[body]++);
    }
    faces_of_body_.resize(count.size());
    for (std::uint32_t f = 0; f < share.faces.faces.size(); ++f) {
      faces_of_body_[share.body[share.faces.material[f]]].push_back(f);
    }
  }

  void run(const Context& context) {
    const std::vector<std::uint32_t> numbers = whole_bodies();
    if (numbers.size() < 2) {
      return;
    }
    std::vector<std::vector<FaceId>> bodies;
    const std::vector<std::vector<FaceId>> all = components(model_);
    for (const std::uint32_t b : numbers) {
      bodies.push_back(all[b]);
    }
    std::vector<bool> taken_out(model_.component_count(), false);
    std::vector<std::uint32_t> copies(model_.component_count(), 1);
    for (const std::vector<Twin>& group : find_twins(model_, bodies, context)) {
      const std::uint32_t first = numbers[group[0].body];
      for (std::size_t i = 1; i < group.size(); ++i) {
        const std::uint32_t body = numbers[group[i].body];
        share_.copies.push_back(copy_of(first, group[i], all[body]));
        taken_out[body] = true;
        ++copies[first];
      }
    }
    take_out(taken_out, copies);
  }

 private:
  /// Components that are in the share with all their faces, uncut.
  [[nodiscard]] std::vector<std::uint32_t> whole_bodies() const {
    std::vector<bool> good(model_.component_count(), false);
    for (const std::uint32_t b : share_.body) {
      good[b] = true;
    }
    const std::uint32_t usual = share_.symmetric() ? 2 : 1;
    for (std::size_t f = 0; f < share_.faces.faces.size(); ++f) {
      for (const std::uint32_t v : share_.faces.faces[f]) {
        if (share_.points.plane[v] != PointRules::none || share_.points.copies[v] != usual) {
          good[share_.body[share_.faces.material[f]]] = false;
        }
      }
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t b = 0; b < good.size(); ++b) {
      if (good[b]) {
        result.push_back(b);
      }
    }
    return result;
  }

  /// `body`: the faces of the twin.
  [[nodiscard]] SymmetricShare::Copy copy_of(std::uint32_t first, const Twin& twin,
                                             const std::vector<FaceId>& body) const {
    SymmetricShare::Copy copy;
    copy.body = first;
    copy.motion = twin.motion;
    copy.origins.resize(faces_of_body_[first].size());
    const TwinFaces partner_of(model_, twin, body);
    for (const std::uint32_t f : faces_of_body_[first]) {
      const std::uint32_t number = share_.faces.material[f];
      const FaceId partner = partner_of(FaceId(share_.origins[number].face));
      const FaceId image = share_.symmetric() ? share_.image[partner] : FaceId();
      copy.origins[share_.rank[number]] = {partner.value(), image.value()};
    }
    return copy;
  }

  void take_out(const std::vector<bool>& taken_out, const std::vector<std::uint32_t>& copies) {
    mesh::LooseFaces kept;
    kept.points = share_.faces.points;
    std::vector<bool> counted(kept.points.size(), false);
    for (std::size_t f = 0; f < share_.faces.faces.size(); ++f) {
      const std::uint32_t body = share_.body[share_.faces.material[f]];
      if (taken_out[body]) {
        continue;
      }
      kept.add(share_.faces, f, share_.faces.faces[f]);
      for (const std::uint32_t v : share_.faces.faces[f]) {
        share_.points.copies[v] *= counted[v] ? 1 : copies[body];
        counted[v] = true;
      }
    }
    share_.faces = std::move(kept);
  }

  SymmetricShare& share_;
  const mesh::Surface& model_;
  std::vector<std::vector<std::uint32_t>> faces_of_body_;  ///< of the share
};

}  // namespace

void share_twins(SymmetricShare& share, const mesh::Surface& model, const Context& context) {
  TwinSharer(share, model).run(context);
}

}  // namespace ridgecraft::prepare
