// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/joining/crumbs.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace ridgecraft::segment {
namespace {

/// A component with at most this part of the largest one's facets is a crumb of a damaged surface.
constexpr std::size_t crumb_ratio = 20;

class Crumbs {
 public:
  Crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
         const UniteParts& unite)
      : surface_(&surface),
        components_(std::move(components)),
        facets_of_(std::move(parts)),
        part_of_(surface.facet_count(), none),
        unite_(&unite),
        size_of_(surface.facet_count(), 0),
        taken_in_(surface.facet_count(), false) {
    for (std::uint32_t p = 0; p < facets_of_.size(); ++p) {
      for (const std::uint32_t f : facets_of_[p]) {
        part_of_[f] = p;
      }
    }
    for (const Facets& component : components_) {
      for (const std::uint32_t f : component) {
        size_of_[f] = component.size();
      }
    }
    std::stable_sort(components_.begin(), components_.end(),
                     [](const Facets& a, const Facets& b) { return a.size() > b.size(); });
  }

  /// A crumb may touch none but others of its size: it follows them in a later pass. Whether some crumb
  /// joined a part.
  bool pass(const Context& context) {
    bool changed = false;
    for (const Facets& crumb : components_) {
      context.check();
      if (!taken_in_[crumb.front()] && crumb.size() * crumb_ratio <= components_.front().size()) {
        changed = absorb(crumb) || changed;
      }
    }
    return changed;
  }

 private:
  bool absorb(const Facets& crumb) {
    std::set<std::uint32_t> tried;
    for (const std::uint32_t g : facets_beside(crumb)) {
      const std::uint32_t into = part_of_[g];
      if (tried.insert(into).second && take_in(crumb, into)) {
        return true;
      }
    }
    return false;
  }

  /// Of larger components, or of such as have joined another part.
  [[nodiscard]] std::set<std::uint32_t> facets_beside(const Facets& crumb) const {
    std::set<std::uint32_t> beside;
    for (const std::uint32_t f : crumb) {
      for (const std::uint32_t v : surface_->corners[f]) {
        for (const std::uint32_t g : surface_->facets_at(v)) {
          if (size_of_[g] > size_of_[f] || (taken_in_[g] && part_of_[g] != part_of_[f])) {
            beside.insert(g);
          }
        }
      }
    }
    return beside;
  }

  /// False where the part would be too concave or has all of the crumb's already.
  bool take_in(const Facets& crumb, std::uint32_t into) {
    std::set<std::uint32_t> parts{into};
    for (const std::uint32_t f : crumb) {
      parts.insert(part_of_[f]);
    }
    const std::vector<std::uint32_t> united(parts.begin(), parts.end());
    if (united.size() == 1 || !(*unite_)(united, into)) {
      return false;
    }
    for (const std::uint32_t p : united) {
      if (p == into) {
        continue;
      }
      for (const std::uint32_t f : facets_of_[p]) {
        part_of_[f] = into;
        facets_of_[into].push_back(f);
      }
      facets_of_[p].clear();
    }
    for (const std::uint32_t f : crumb) {
      taken_in_[f] = true;
    }
    return true;
  }

  const ScaledSurface* surface_;
  std::vector<Facets> components_;  ///< largest first
  std::vector<Facets> facets_of_;   ///< of each part
  std::vector<std::uint32_t> part_of_;
  const UniteParts* unite_;
  std::vector<std::size_t> size_of_;  ///< of each facet's component
  std::vector<bool> taken_in_;
};

}  // namespace

void absorb_crumbs(const ScaledSurface& surface, std::vector<Facets> components, std::vector<Facets> parts,
                   const UniteParts& unite, const Context& context) {
  Crumbs crumbs(surface, std::move(components), std::move(parts), unite);
  while (crumbs.pass(context)) {
  }
}

}  // namespace ridgecraft::segment
