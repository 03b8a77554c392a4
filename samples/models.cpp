// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/models.hpp"

#include <array>

namespace ridgecraft::samples {

std::span<const Sample> all() {
  static constexpr std::array samples = {Sample{"whale.obj", whale},
                                         Sample{"fish.obj", fish},
                                         Sample{"dinosaur.obj", dinosaur},
                                         Sample{"fox_head.obj", fox_head},
                                         Sample{"penguin.obj", penguin},
                                         Sample{"house.obj", house},
                                         Sample{"lighthouse.obj", lighthouse},
                                         Sample{"rocket.obj", rocket},
                                         Sample{"mug.obj", mug},
                                         Sample{"vase.ply", vase},
                                         Sample{"chess_rook.obj", chess_rook},
                                         Sample{"torus.off", torus},
                                         Sample{"heart.obj", heart},
                                         Sample{"gem.stl", gem},
                                         Sample{"star.obj", star},
                                         Sample{"packaging_box.obj", packaging_box, false}};
  return samples;
}

}  // namespace ridgecraft::samples
