// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/sheet/pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/text.hpp"

namespace ridgecraft::export_ {
namespace {

/// Objects of one kind are mostly numbered: wheel.001, wheel_2.
std::string without_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  if (last == std::string::npos) {
    return {};
  }
  const std::size_t end = name.find_last_not_of("0123456789._- #");
  return last + 1 == name.size() ? name : name.substr(0, end + 1);
}

/// Who is called what, face by face.
class Names {
 public:
  Names(const prepare::Prepared& prepared, const unfold::Nets& nets) : model_(prepared.model), nets_(nets) {
    const mesh::Model& model = prepared.model;
    for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
      for (const FaceId f : nets.pieces[p].faces) {
        const std::string& name = model.object_name(f);
        objects_of_name_[without_number(name)].insert(name);
      }
    }
    for (const FaceId f : ids<FaceId>(model.material.size())) {
      if (model.material[f] != mesh::Soup::none) {
        pieces_of_material_[model.material[f]].insert(nets.piece[f]);
      }
    }
  }

  /// The name that all faces of these pieces share but for a number, where there is one of each object that
  /// is called so: "4 x car" would be four cars. Empty elsewhere.
  [[nodiscard]] std::string of_objects(const std::vector<unfold::EqualPiece>& kind) const {
    std::set<std::string> names;
    std::set<std::string> own;
    for (const unfold::EqualPiece& equal : kind) {
      for (const FaceId f : nets_.pieces[equal.piece].faces) {
        own.insert(model_.object_name(f));
        names.insert(without_number(model_.object_name(f)));
        if (names.size() > 1) {
          return {};
        }
      }
    }
    const bool one_of_each = own == objects_of_name_.at(*names.begin()) && own.size() == kind.size();
    return one_of_each ? *names.begin() : std::string();
  }

  [[nodiscard]] std::string of_material(const std::vector<unfold::EqualPiece>& kind) const {
    if (model_.material.empty()) {
      return {};
    }
    const std::uint32_t material = model_.material[nets_.pieces[kind.front().piece].faces.front()];
    std::set<PieceId> pieces;
    for (const unfold::EqualPiece& equal : kind) {
      pieces.insert(equal.piece);
      for (const FaceId f : nets_.pieces[equal.piece].faces) {
        if (model_.material[f] != material) {
          return {};
        }
      }
    }
    const auto found = pieces_of_material_.find(material);
    return found != pieces_of_material_.end() && found->second == pieces
               ? without_number(model_.materials[material].name)
               : std::string();
  }

 private:
  const mesh::Model& model_;
  const unfold::Nets& nets_;
  std::map<std::string, std::set<std::string>> objects_of_name_;  ///< whose names are one but for a number
  std::map<std::uint32_t, std::set<PieceId>> pieces_of_material_;
};

std::string listed(const unfold::Nets& nets, const std::vector<PieceId>& pieces, std::size_t most) {
  if (pieces.size() > 2 && pieces.back().value() - pieces.front().value() + 1 == pieces.size()) {
    return nets.pieces[pieces.front()].name + " to " + nets.pieces[pieces.back()].name;
  }
  std::string text;
  for (std::size_t i = 0; i < std::min(most, pieces.size()); ++i) {
    text += (i == 0 ? "" : ", ") + nets.pieces[pieces[i]].name;
  }
  return text + (pieces.size() > most ? ", ..." : "");
}

}  // namespace

std::vector<PieceKind> find_piece_kinds(const prepare::Prepared& model, const unfold::Nets& nets) {
  std::vector<PieceKind> kinds;
  const Names names(model, nets);
  for (const std::vector<unfold::EqualPiece>& equal : nets.equal) {
    PieceKind& kind = kinds.emplace_back();
    for (const unfold::EqualPiece& piece : equal) {
      (piece.mirrored ? kind.mirrored : kind.pieces).push_back(piece.piece);
      kind.tabs_differ |= piece.other_tabs;
    }
    const std::string object = names.of_objects(equal);
    kind.name = printable_utf8(object.empty() ? names.of_material(equal) : object);
  }
  return kinds;
}

IdVector<PieceId, std::string> find_piece_objects(const prepare::Prepared& prepared,
                                                  const unfold::Nets& nets) {
  const mesh::Model& model = prepared.model;
  IdVector<PieceId, std::string> names(nets.pieces.size());
  std::set<std::string> all;
  for (const PieceId p : ids<PieceId>(nets.pieces.size())) {
    std::set<std::string> own;
    for (const FaceId f : nets.pieces[p].faces) {
      own.insert(model.object_name(f));
    }
    all.insert(own.begin(), own.end());
    if (own.size() == 1) {
      names[p] = printable_utf8(*own.begin());
    }
  }
  if (all.size() < 2) {
    return IdVector<PieceId, std::string>(nets.pieces.size());
  }
  return names;
}

std::string kind_words(const unfold::Nets& nets, const PieceKind& kind, std::size_t most) {
  const std::string but = kind.tabs_differ ? " but for tabs" : "";
  if (kind.name.empty() && kind.pieces.size() == 1 && kind.mirrored.size() == 1) {
    return listed(nets, kind.pieces, most) + " and " + listed(nets, kind.mirrored, most) +
           " are mirror images" + but;
  }
  std::string text = std::to_string(kind.count());
  text +=
      kind.name.empty() ? " equal" + but : " \u00d7 " + kind.name + (kind.tabs_differ ? ", equal" + but : "");
  text += ": " + listed(nets, kind.pieces, most);
  return text + (kind.mirrored.empty() ? "" : ", mirrored: " + listed(nets, kind.mirrored, most));
}

IdVector<PieceId, std::vector<Neighbour>> find_neighbours(const mesh::Surface& surface,
                                                          const unfold::Nets& nets) {
  std::vector<std::tuple<PieceId, PieceId, std::uint32_t>> joins;
  for (const unfold::Join& join : nets.joins) {
    const auto [c, d] = surface.sides(join.edge);
    const PieceId first = nets.piece[mesh::face_of(c)];
    const PieceId second = nets.piece[mesh::face_of(d)];
    if (first != second) {
      joins.emplace_back(first, second, join.number);
      joins.emplace_back(second, first, join.number);
    }
  }
  std::sort(joins.begin(), joins.end());
  joins.erase(std::unique(joins.begin(), joins.end()), joins.end());
  IdVector<PieceId, std::vector<Neighbour>> result(nets.pieces.size());
  for (const auto& [piece, other, number] : joins) {
    std::vector<Neighbour>& neighbours = result[piece];
    if (neighbours.empty() || neighbours.back().piece != other) {
      neighbours.push_back({other, {}});
    }
    neighbours.back().numbers.push_back(number);
  }
  return result;
}

std::string number_ranges(const std::vector<std::uint32_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) {
      ++end;
    }
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[i]);
    if (end - i > 2) {
      text += "-" + std::to_string(numbers[end - 1]);
      i = end;
    } else {
      ++i;
    }
  }
  return text;
}

}  // namespace ridgecraft::export_
