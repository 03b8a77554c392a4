// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/scene_soup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/scene.h>

#include "mesh/reading/imported/stream.hpp"

namespace ridgecraft::import {
namespace {

namespace stream = mesh::imported;

/// Copies of objects may make so many corners more than the file holds itself.
constexpr std::uint64_t most_repeated_corners = 6'000'000;
/// Nodes that hold each other deeper than this are a mistake of the file.
constexpr unsigned deepest_node = 1000;

/// A place and turn in doubles: products of many floats would lose digits.
struct Motion {
  std::array<std::array<double, 4>, 3> row{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  static Motion of(const aiMatrix4x4& m) {
    return {{{{double{m.a1}, double{m.a2}, double{m.a3}, double{m.a4}},
              {double{m.b1}, double{m.b2}, double{m.b3}, double{m.b4}},
              {double{m.c1}, double{m.c2}, double{m.c3}, double{m.c4}}}}};
  }
  [[nodiscard]] std::array<double, 3> operator()(const aiVector3D& p) const {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = row[i][0] * double{p.x} + row[i][1] * double{p.y} + row[i][2] * double{p.z} + row[i][3];
    }
    return result;
  }
  [[nodiscard]] Motion after(const Motion& first) const {
    Motion result;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        result.row[i][k] = row[i][0] * first.row[0][k] + row[i][1] * first.row[1][k] +
                           row[i][2] * first.row[2][k] + (k == 3 ? row[i][3] : 0.0);
      }
    }
    return result;
  }
  [[nodiscard]] bool mirrors() const {
    const auto& [a, b, c] = row;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]) <
           0.0;
  }
};

class SoupMaker {
 public:
  SoupMaker(const aiScene& scene, const std::string& format) : scene_(scene), format_(format) {}

  std::string make() {
    limit_repetitions(*scene_.mRootNode, 0);
    if (corners_ > std::max(most_repeated_corners, own_corners())) {
      throw std::runtime_error("its objects repeat each other without end");
    }
    find_places(*scene_.mRootNode, Motion());
    add(*scene_.mRootNode, Motion());
    StreamWriter out;
    out.words(stream::start);
    out.index(stream::kind_soup);
    write_frame(out);
    out.index(moves() ? 1 : 0);
    write_materials(out);
    out.index(static_cast<std::uint32_t>(points_.size()));
    for (const std::array<double, 3>& p : points_) {
      for (const double x : p) {
        out.number(x);
      }
    }
    out.index(static_cast<std::uint32_t>(places_.size()));
    for (const std::array<double, 2>& place : places_) {
      out.number(place[0]);
      out.number(place[1]);
    }
    out.index(static_cast<std::uint32_t>(objects_.size()));
    for (const auto& [first, name] : objects_) {
      out.index(first);
      out.text(name);
    }
    out.index(static_cast<std::uint32_t>(polygon_size_.size()));
    out.indices(polygon_size_);
    out.index(static_cast<std::uint32_t>(corner_point_.size()));
    out.indices(corner_point_);
    out.indices(corner_place_);
    out.indices(corner_colour_);
    out.indices(polygon_material_);
    out.words(stream::end);
    return out.take();
  }

 private:
  [[nodiscard]] static std::uint64_t corners_of(const aiMesh& mesh) {
    std::uint64_t corners = mesh.mNumVertices;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      corners += mesh.mFaces[f].mNumIndices;
    }
    return corners;
  }
  [[nodiscard]] std::uint64_t own_corners() const {
    std::uint64_t corners = 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      corners += corners_of(*scene_.mMeshes[i]);
    }
    return corners;
  }

  /// Before anything is made of them.
  void limit_repetitions(const aiNode& node, unsigned depth) {
    if (depth > deepest_node || ++nodes_ > most_repeated_corners) {
      throw std::runtime_error("its objects hold each other too deep");
    }
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      corners_ += corners_of(*scene_.mMeshes[node.mMeshes[i]]);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      limit_repetitions(*node.mChildren[i], depth + 1);
    }
  }

  /// Where each node is that a bone may name; of several of one name the first.
  void find_places(const aiNode& node, const Motion& above) {
    const Motion motion = above.after(Motion::of(node.mTransformation));
    place_of_node_.try_emplace(node.mName.C_Str(), motion);
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      find_places(*node.mChildren[i], motion);
    }
  }

  /// Points of a skin are where its bones hold them; those that none holds where the node is. Assimp gives
  /// the other formats' skins at rest already.
  [[nodiscard]] std::vector<std::array<double, 3>> points_of(const aiMesh& mesh, const Motion& motion) const {
    std::vector<std::array<double, 3>> points(mesh.mNumVertices);
    std::vector<double> held(mesh.mNumVertices, 0.0);
    for (unsigned b = 0; format_ == "DAE" && b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const auto place = place_of_node_.find(bone.mName.C_Str());
      if (place == place_of_node_.end()) {
        continue;
      }
      const Motion bend = place->second.after(Motion::of(bone.mOffsetMatrix));
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const unsigned v = bone.mWeights[w].mVertexId;
        const double weight = bone.mWeights[w].mWeight;
        if (v >= mesh.mNumVertices || !(weight > 0.0)) {
          continue;
        }
        const std::array<double, 3> at = bend(mesh.mVertices[v]);
        for (std::size_t k = 0; k < 3; ++k) {
          points[v][k] += weight * at[k];
        }
        held[v] += weight;
      }
    }
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      if (held[v] > 0.0) {
        std::for_each(points[v].begin(), points[v].end(), [&](double& x) { x /= held[v]; });
      } else {
        points[v] = motion(mesh.mVertices[v]);
      }
    }
    return points;
  }

  void add(const aiNode& node, const Motion& above) {
    const Motion motion = above.after(Motion::of(node.mTransformation));
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      objects_.emplace_back(static_cast<std::uint32_t>(polygon_size_.size()), name_of(node, mesh));
      add(mesh, motion);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      add(*node.mChildren[i], motion);
    }
  }

  /// What the artist called the object; its mesh may have another name. Assimp numbers the nodes that it
  /// makes of 3DS files without any: these are no names.
  [[nodiscard]] static std::string name_of(const aiNode& node, const aiMesh& mesh) {
    const std::string name = node.mName.C_Str();
    if (name.starts_with("3DSMesh_")) {
      return {};
    }
    return name.empty() || node.mParent == nullptr ? mesh.mName.C_Str() : name;
  }

  [[nodiscard]] static std::optional<aiColor3D> colour_of(const aiMaterial& material) {
    aiColor3D colour(1, 1, 1);
    const bool told = material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
                      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
    return told ? std::optional(colour) : std::nullopt;
  }

  /// Whether the colours of a mesh's points are what it looks like: games keep other things in them, so a
  /// material that isn't grey counts more. Programs write white where nobody has painted anything.
  [[nodiscard]] bool tells_colours(const aiMesh& mesh) const {
    if (!mesh.HasVertexColors(0)) {
      return false;
    }
    if (mesh.mMaterialIndex < scene_.mNumMaterials) {
      const auto material = colour_of(*scene_.mMaterials[mesh.mMaterialIndex]);
      if (material && (material->r != material->g || material->g != material->b)) {
        return false;
      }
    }
    const auto* const colours = mesh.mColors[0];
    return std::any_of(colours, colours + mesh.mNumVertices,
                       [](const aiColor4D& colour) { return packed_colour(colour) != 0xffffff; });
  }
  /// 0xRRGGBB
  [[nodiscard]] static std::uint32_t packed_colour(const aiColor4D& colour) {
    std::uint32_t packed = 0;
    for (const float channel : {colour.r, colour.g, colour.b}) {
      packed = packed << 8U |
               static_cast<std::uint32_t>(channel > 0.0F ? std::min(channel, 1.0F) * 255.0F + 0.5F : 0.0F);
    }
    return packed;
  }

  void add(const aiMesh& mesh, const Motion& motion) {
    const auto first_point = static_cast<std::uint32_t>(points_.size());
    const auto first_place = static_cast<std::uint32_t>(places_.size());
    const bool has_places = mesh.HasTextureCoords(0);
    const bool has_colours = tells_colours(mesh);
    const std::vector<std::array<double, 3>> points = points_of(mesh, motion);
    points_.insert(points_.end(), points.begin(), points.end());
    for (unsigned v = 0; has_places && v < mesh.mNumVertices; ++v) {
      places_.push_back({mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y});
    }
    const bool mirrors = motion.mirrors();
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        continue;  // points and lines
      }
      polygon_size_.push_back(face.mNumIndices);
      polygon_material_.push_back(mesh.mMaterialIndex < scene_.mNumMaterials ? mesh.mMaterialIndex
                                                                             : stream::no_index);
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned v = face.mIndices[mirrors ? face.mNumIndices - 1 - k : k];
        if (v >= mesh.mNumVertices) {
          throw std::runtime_error("a face names a point that isn't there");
        }
        corner_point_.push_back(first_point + v);
        corner_place_.push_back(has_places ? first_place + v : stream::no_index);
        corner_colour_.push_back(has_colours ? packed_colour(mesh.mColors[0][v]) : stream::no_index);
      }
    }
  }

  /// A number that the file tells beside its shape.
  [[nodiscard]] std::optional<double> metadata(const char* key) const {
    if (scene_.mMetaData == nullptr) {
      return std::nullopt;
    }
    float single = 0;
    double full = 0;
    std::int32_t whole = 0;
    if (scene_.mMetaData->Get(key, full)) {
      return full;
    }
    if (scene_.mMetaData->Get(key, single)) {
      return single;
    }
    if (scene_.mMetaData->Get(key, whole)) {
      return whole;
    }
    return std::nullopt;
  }

  /// Assimp turns COLLADA and 3DS so that y is up, and COLLADA to metres; Blender's files stay as they are;
  /// of FBX it tells only what the file says.
  void write_frame(StreamWriter& out) const {
    constexpr double mm_per_cm = 10.0;
    constexpr double digits = 1e4;
    constexpr double mm_per_m = 1000.0;
    constexpr std::uint32_t y = 1;
    constexpr std::uint32_t z = 2;
    double unit = 0.0;
    std::uint32_t up = stream::axis_untold;
    if (format_ == "FBX") {
      // As a float it has about seven digits: an inch is 25.4 mm.
      unit = std::round(digits * mm_per_cm * metadata("UnitScaleFactor").value_or(0.0)) / digits;
      const double axis = metadata("UpAxis").value_or(-1.0);
      up = axis >= 0.0 && axis <= 2.0 ? static_cast<std::uint32_t>(axis) : stream::axis_untold;
    } else if (format_ == "DAE") {
      unit = mm_per_m;
      up = y;
    } else if (format_ == "3DS") {
      up = y;
    } else if (format_ == "BLEND") {
      up = z;
    }
    out.number(unit);
    out.index(up);
  }

  /// Whether something bends or is animated: what is written is the model at rest.
  [[nodiscard]] bool moves() const {
    bool found = scene_.mNumAnimations > 0;
    for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
      found = found || scene_.mMeshes[i]->HasBones() || scene_.mMeshes[i]->mNumAnimMeshes > 0;
    }
    return found;
  }

  void write_materials(StreamWriter& out) const {
    out.index(scene_.mNumMaterials);
    for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
      const aiMaterial& material = *scene_.mMaterials[i];
      aiString name;
      material.Get(AI_MATKEY_NAME, name);
      out.text({name.data, name.length});
      const std::optional<aiColor3D> told = colour_of(material);
      const aiColor3D colour = told.value_or(aiColor3D(1, 1, 1));
      out.index(told ? 1 : 0);
      out.number(colour.r);
      out.number(colour.g);
      out.number(colour.b);
      write_picture(material, out);
    }
  }

  void write_picture(const aiMaterial& material, StreamWriter& out) const {
    aiString path;
    const bool has_picture = material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) == aiReturn_SUCCESS ||
                             material.GetTexture(aiTextureType_DIFFUSE, 0, &path) == aiReturn_SUCCESS;
    std::string_view name(path.data, path.length);
    // Blender's patterns have no picture; what it names from the model's folder on begins with two slashes.
    if (name.starts_with("Procedural,")) {
      name = {};
    }
    if (name.starts_with("//")) {
      name.remove_prefix(2);
    }
    if (!has_picture || name.empty()) {
      out.index(stream::picture_none);
      out.text({});
      return;
    }
    const aiTexture* const within = scene_.GetEmbeddedTexture(path.C_Str());
    // Without a height the texture is a picture file of mWidth bytes; others, bare dots, are rare.
    if (within != nullptr && within->mHeight == 0) {
      out.index(stream::picture_bytes);
      out.text({reinterpret_cast<const char*>(within->pcData), within->mWidth});
      return;
    }
    out.index(within != nullptr ? stream::picture_none : stream::picture_file);
    out.text(within != nullptr ? std::string_view() : name);
  }

  const aiScene& scene_;
  const std::string& format_;
  std::uint64_t nodes_ = 0;
  std::uint64_t corners_ = 0;
  std::map<std::string, Motion> place_of_node_;
  std::vector<std::array<double, 3>> points_;
  std::vector<std::array<double, 2>> places_;
  std::vector<std::pair<std::uint32_t, std::string>> objects_;
  std::vector<std::uint32_t> polygon_size_, corner_point_, corner_place_, corner_colour_, polygon_material_;
};

}  // namespace

std::string soup_stream(const aiScene& scene, const std::string& format) {
  return SoupMaker(scene, format).make();
}

}  // namespace ridgecraft::import
