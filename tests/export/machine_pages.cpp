// SPDX-License-Identifier: GPL-3.0-or-later
#include "machine_pages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "sample_pages.hpp"
#include "support/shapes.hpp"

namespace ridgecraft::test {

std::vector<export_::Drawing> pages_for_machines() {
  std::vector<export_::Drawing> all;
  const auto add = [&](const SamplePages& sample) {
    std::vector<export_::Drawing> drawn = export_::draw({sample.model, sample.nets, sample.pages}, {});
    drawn.resize(sample.pages.count);  // without pages of lists
    std::move(drawn.begin(), drawn.end(), std::back_inserter(all));
  };
  add(sample_pages(cube(), 40.0, 5.0, {}, "Cube", {}, 0.3));
  const mesh::Surface ball = sphere(12, 7);
  add(sample_pages(ball, 60.0, 5.0, all_edges(ball), "Ball", export_::parse_paper("letter")));
  add(sample_pages(voxels({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 25.0, 4.0, {}, "Corner",
                   export_::parse_paper("A3-landscape"), 1.1));
  return all;
}

}  // namespace ridgecraft::test
