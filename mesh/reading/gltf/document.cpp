// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/gltf/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/encodings.hpp"
#include "base/text.hpp"
#include "mesh/reading/files.hpp"
#include "mesh/reading/gltf/meshopt.hpp"
#include "mesh/reading/text_scanner.hpp"

namespace ridgecraft::mesh {
namespace {

using Json = nlohmann::json;

/// JSON has one kind of number: 3.0 is as whole as 3.
std::optional<std::uint64_t> whole_number(const Json& value) {
  // Beyond this not every whole number is a double.
  constexpr double largest = 9007199254740992.0;
  if (value.is_number_unsigned()) {
    return value.get<std::uint64_t>();
  }
  const double number = value.is_number_float() ? value.get<double>() : -1.0;
  if (number < 0.0 || number > largest || number != std::floor(number)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(number);
}

constexpr std::size_t glb_header_size = 12;
constexpr std::size_t glb_chunk_header_size = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534AU;
constexpr std::uint32_t binary_chunk = 0x004E4942U;

/// Numbers of shapes lie in buffers, so a file's JSON is small. These keep its tree below some 400 MB.
constexpr std::size_t largest_value_count = 4'000'000;
constexpr int deepest_nesting = 200;
/// What is unpacked of a file, 1 GiB.
constexpr std::uint64_t most_unpacked_views = std::uint64_t{1} << 30U;

std::uint32_t uint32_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint32_t>(little_endian(bytes.substr(at, 4)));
}

[[noreturn]] void refuse_version(const Source& source, std::string_view version) {
  source.refuse(
      ErrorKind::unreadable_input,
      fmt::format("is a glTF {} model, and only version 2 is read: open it in another program, such as "
                  "Blender, and export it as glTF 2",
                  printable(version)));
}

/// Looks a JSON text through for what would make its tree too large. An error in the text ends it in silence:
/// who builds the tree finds it again.
class SizeCheck : public nlohmann::json_sax<Json> {
 public:
  explicit SizeCheck(const Source& source) : source_(source) {}

  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool key(string_t&) override { return count(); }
  bool start_object(std::size_t) override { return enter(); }
  bool start_array(std::size_t) override { return enter(); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }

 private:
  bool count() {
    if (++values_ > largest_value_count) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("has more than {} values besides its buffers", largest_value_count));
    }
    if (values_ % 65536 == 0) {
      source_.context.check();
    }
    return true;
  }
  bool enter() {
    if (++depth_ > deepest_nesting) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("is nested more than {} levels deep", deepest_nesting));
    }
    return count();
  }
  bool leave() {
    --depth_;
    return true;
  }

  const Source& source_;
  std::size_t values_ = 0;
  int depth_ = 0;
};

Json parse_json(const Source& source, std::string_view text) {
  // Two passes: the library's parser with a callback looks, at the end of each object, through all that stand
  // beside it, which takes hours for a million.
  SizeCheck check(source);
  (void)Json::sax_parse(text.begin(), text.end(), &check);
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(text.size(), error.byte == 0 ? 0 : error.byte - 1);
    source.refuse_line(ErrorKind::unreadable_input, text.data() + at,
                       at == text.size() ? "the JSON ends here, cut off" : "this is no valid JSON");
  } catch (const Json::exception&) {
    source.refuse(ErrorKind::unreadable_input, "holds a number that is too large");
  }
}

/// What an extension is about, by the start of its name: the look of surfaces, lights, data about the file.
/// The shape is complete without it.
constexpr std::array without_effect{"KHR_materials_",  "KHR_texture_", "EXT_texture_",     "MSFT_texture_",
                                    "KHR_lights_",     "EXT_lights_",  "KHR_technique",    "KHR_xmp",
                                    "KHR_animation_",  "KHR_audio",    "MSFT_packing_",    "ADOBE_materials_",
                                    "VRMC_materials_", "FB_",          "KHR_interactivity"};
/// Those that this reader knows.
constexpr std::array known{"KHR_mesh_quantization",   "KHR_texture_transform",   "KHR_draco_mesh_compression",
                           "EXT_meshopt_compression", "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"};

bool is_about_looks(std::string_view extension) {
  return std::any_of(without_effect.begin(), without_effect.end(),
                     [&](const char* start) { return extension.starts_with(start); });
}

}  // namespace

const Json* GltfObject::find(const char* key) const {
  const auto found = json_->find(key);
  return found == json_->end() ? nullptr : &*found;
}

const Json* GltfObject::find(const char* key, bool (Json::*is_right)() const noexcept,
                             std::string_view type) const {
  const Json* const value = find(key);
  if (value != nullptr && !(value->*is_right)()) {
    refuse_value(key, type);
  }
  return value;
}

const Json* GltfObject::list(const char* key) const {
  return find(key, &Json::is_array, "list");
}

std::string GltfObject::inside(const char* key) const {
  return place_.empty() ? std::string(key) : place_ + "." + key;
}

void GltfObject::refuse(std::string_view reason, ErrorKind kind) const {
  if (place_.empty()) {
    source_->refuse(kind, fmt::format("can't be read as glTF: {}", reason));
  }
  throw Error(kind, fmt::format("{}, {}: {}", source_->file, place_, reason), source_->file);
}

void GltfObject::refuse_value(const char* key, std::string_view wanted) const {
  refuse(fmt::format("\"{}\" is no {}", key, wanted));
}

std::optional<std::uint64_t> GltfObject::whole(const char* key) const {
  const Json* const value = find(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  const auto number = whole_number(*value);
  if (!number) {
    refuse_value(key, "whole number");
  }
  return number;
}

std::uint64_t GltfObject::needed_whole(const char* key) const {
  const auto number = whole(key);
  if (!number) {
    refuse(fmt::format("\"{}\" is missing", key));
  }
  return *number;
}

std::optional<double> GltfObject::number(const char* key) const {
  const Json* const value = find(key, &Json::is_number, "number");
  return value == nullptr ? std::nullopt : std::optional(value->get<double>());
}

bool GltfObject::truth(const char* key) const {
  const Json* const value = find(key, &Json::is_boolean, "truth value");
  return value != nullptr && value->get<bool>();
}

std::string GltfObject::text(const char* key) const {
  const Json* const value = find(key, &Json::is_string, "text");
  return value == nullptr ? std::string() : value->get<std::string>();
}

std::optional<std::vector<double>> GltfObject::numbers(const char* key) const {
  const Json* const values = list(key);
  if (values == nullptr) {
    return std::nullopt;
  }
  std::vector<double> numbers;
  numbers.reserve(values->size());
  for (const Json& value : *values) {
    if (!value.is_number()) {
      refuse_value(key, "list of numbers");
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

std::optional<std::vector<double>> GltfObject::numbers(const char* key, std::size_t count) const {
  auto values = numbers(key);
  if (values && values->size() != count) {
    refuse(fmt::format("\"{}\" has {} numbers instead of {}", key, values->size(), count));
  }
  return values;
}

std::vector<std::uint64_t> GltfObject::wholes(const char* key) const {
  std::vector<std::uint64_t> numbers;
  if (const Json* const values = list(key)) {
    numbers.reserve(values->size());
    for (const Json& value : *values) {
      const auto number = whole_number(value);
      if (!number) {
        refuse_value(key, "list of whole numbers");
      }
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<std::string> GltfObject::texts(const char* key) const {
  std::vector<std::string> texts;
  if (const Json* const values = list(key)) {
    for (const Json& value : *values) {
      if (!value.is_string()) {
        refuse_value(key, "list of texts");
      }
      texts.push_back(value.get<std::string>());
    }
  }
  return texts;
}

std::optional<GltfObject> GltfObject::object(const char* key) const {
  const Json* const value = find(key, &Json::is_object, "object");
  return value == nullptr ? std::nullopt : std::optional(GltfObject(*source_, *value, inside(key)));
}

std::size_t GltfObject::size(const char* key) const {
  const Json* const values = list(key);
  return values == nullptr ? 0 : values->size();
}

GltfObject GltfObject::element(const char* key, std::uint64_t i) const {
  const std::size_t count = size(key);
  if (i >= count) {
    refuse(count == 0 ? fmt::format("\"{}\" has no element {}: it is empty", key, i)
                      : fmt::format("\"{}\" has no element {}, only 0 to {}", key, i, count - 1));
  }
  const Json& value = (*find(key))[static_cast<std::size_t>(i)];
  std::string place = fmt::format("{}[{}]", inside(key), i);
  if (!value.is_object()) {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}, {}: it is no object", source_->file, place),
                source_->file);
  }
  return {*source_, value, std::move(place)};
}

std::optional<GltfObject> GltfObject::extension(const char* name) const {
  const auto extensions = object("extensions");
  return extensions ? extensions->object(name) : std::nullopt;
}

constexpr std::string_view scheme = "data:";

bool is_data_uri(std::string_view uri) {
  return equal_ignoring_case(uri.substr(0, scheme.size()), scheme);
}

std::optional<std::string> data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == uri.npos) {
    return std::nullopt;
  }
  const std::string_view text = uri.substr(comma + 1);
  if (!uri.substr(0, comma).ends_with(";base64")) {
    return from_percent(text);
  }
  return text.find('%') == text.npos ? from_base64(text) : from_base64(from_percent(text));
}

GltfContainer open_glb(const Source& source) {
  const std::string_view bytes = source.bytes;
  const auto cut_off = [&] {
    source.refuse(
        ErrorKind::unreadable_input,
        fmt::format("is cut off: it ends after {} bytes, within the GLB file's parts", bytes.size()));
  };
  if (bytes.size() < glb_header_size) {
    cut_off();
  }
  if (const std::uint32_t version = uint32_at(bytes, 4); version != 2) {
    refuse_version(source, std::to_string(version));
  }
  const std::uint64_t length = uint32_at(bytes, 8);
  GltfContainer container;
  bool has_json = false;
  std::size_t at = glb_header_size;
  while (at + glb_chunk_header_size <= std::min<std::uint64_t>(length, bytes.size())) {
    const std::uint32_t size = uint32_at(bytes, at);
    const std::uint32_t kind = uint32_at(bytes, at + 4);
    at += glb_chunk_header_size;
    if (size > bytes.size() - at) {
      cut_off();
    }
    const std::string_view chunk = bytes.substr(at, size);
    if (!has_json && kind != json_chunk) {
      source.refuse(ErrorKind::unreadable_input, "is no valid GLB file: its first part isn't JSON");
    }
    if (!has_json) {
      container.json = chunk;
      has_json = true;
    } else if (kind == binary_chunk && !container.binary) {
      container.binary = chunk;
    }
    at += size;
  }
  if (!has_json || length > bytes.size()) {
    cut_off();
  }
  container.trailing = bytes.size() - std::max<std::size_t>(at, static_cast<std::size_t>(length));
  return container;
}

GltfDocument::GltfDocument(const Source& source, const GltfContainer& container)
    : source_(source),
      binary_(container.binary),
      json_(std::make_unique<const Json>(parse_json(source, container.json))),
      held_(source.bytes.size()) {
  if (!json_->is_object()) {
    source.refuse(ErrorKind::unreadable_input, "can't be read as glTF: its JSON is no object");
  }
  root_.emplace(source_, *json_, std::string());
  check_version();
  check_extensions();
}

void GltfDocument::check_version() const {
  // In version 1 lists were objects, and the version needn't be told.
  for (const char* list : {"accessors", "meshes", "nodes", "bufferViews"}) {
    if (const auto found = json_->find(list); found != json_->end() && found->is_object()) {
      refuse_version(source_, "1.0");
    }
  }
  const auto asset = root_->object("asset");
  if (!asset || !asset->has("version")) {
    root_->refuse("\"asset\" with its \"version\" is missing");
  }
  const std::string version = asset->text("version");
  if (!version.starts_with("2.") && version != "2") {
    refuse_version(source_, version);
  }
  const std::string least = asset->text("minVersion");
  if (!least.empty() && least != "2.0" && least != "2") {
    refuse_version(source_, least);
  }
}

void GltfDocument::check_extensions() const {
  for (const std::string& extension : root_->texts("extensionsRequired")) {
    if (!is_about_looks(extension) && std::find(known.begin(), known.end(), extension) == known.end()) {
      source_.refuse(ErrorKind::unreadable_input,
                     fmt::format("can only be read with the extension {}, which isn't known: export it again "
                                 "without it",
                                 in_quotes(extension)));
    }
  }
}

GltfObject GltfDocument::element(const char* list, std::uint64_t i, const GltfObject& user) const {
  const std::size_t count = root_->size(list);
  if (i >= count) {
    user.refuse(count == 0 ? fmt::format("it names {}[{}], but there are none", list, i)
                           : fmt::format("it names {0}[{1}], but there are only {0}[0] to {0}[{2}]", list, i,
                                         count - 1));
  }
  return root_->element(list, i);
}

GltfView GltfDocument::view(std::uint64_t i, const GltfObject& user) {
  const GltfObject view = element("bufferViews", i, user);
  GltfView result;
  for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (const auto packed = view.extension(name); packed && !unpacked_.contains(i)) {
      const MeshoptElements elements{packed->needed_whole("count"), packed->needed_whole("byteStride"),
                                     packed->text("mode"), packed->text("filter")};
      // A few bytes may claim to hold any number.
      if (elements.stride > 0 && elements.count > (most_unpacked_views - unpacked_bytes_) / elements.stride) {
        view.refuse("with it the file is too large, unpacked");
      }
      auto unpacked = unpack_meshopt(elements, bytes_in_buffer(*packed));
      if (!unpacked) {
        packed->refuse(reads_meshopt()
                           ? "its meshopt data is damaged"
                           : "it is compressed with meshopt, which isn't read here: export it again "
                             "without compression");
      }
      const std::string& bytes = unpacked_.emplace(i, std::move(*unpacked)).first->second;
      held_ += bytes.size();
      unpacked_bytes_ += bytes.size();
    }
  }
  const auto unpacked = unpacked_.find(i);
  result.bytes = unpacked != unpacked_.end() ? std::string_view(unpacked->second) : bytes_in_buffer(view);
  if (const auto stride = view.whole("byteStride")) {
    constexpr std::uint64_t largest_stride = 252;  // by the standard
    if (*stride == 0 || *stride > largest_stride) {
      view.refuse("\"byteStride\" isn't from 1 to 252");
    }
    result.stride = static_cast<std::size_t>(*stride);
  }
  return result;
}

void GltfDocument::unpack_view_of(const GltfObject& accessor) {
  if (const auto number = accessor.whole("bufferView")) {
    (void)view(*number, accessor);
  }
}

/// What a view, or the extension of one, names.
std::string_view GltfDocument::bytes_in_buffer(const GltfObject& part) {
  const std::string_view bytes = buffer(part.needed_whole("buffer"), part);
  const std::uint64_t offset = part.whole_or("byteOffset", 0);
  const std::uint64_t length = part.needed_whole("byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    part.refuse(fmt::format("it ends after its buffer, which has {} bytes", bytes.size()));
  }
  return bytes.substr(offset, length);
}

std::string_view GltfDocument::buffer(std::uint64_t i, const GltfObject& user) {
  const GltfObject buffer = element("buffers", i, user);
  const std::uint64_t length = buffer.needed_whole("byteLength");
  std::string_view bytes;
  if (i == 0 && binary_ && !buffer.has("uri")) {
    bytes = *binary_;
  } else {
    auto found = opened_.find(i);
    if (found == opened_.end()) {
      found = opened_.emplace(i, open_buffer(buffer)).first;
    }
    bytes = found->second;
  }
  if (length > bytes.size()) {
    buffer.refuse(fmt::format("it is cut off: it has {} bytes instead of {}", bytes.size(), length));
  }
  return bytes.substr(0, length);
}

std::vector<std::string> GltfDocument::files_beside() const {
  std::vector<std::string> files;
  for (const auto& [file, bytes] : files_) {
    files.push_back(file);
  }
  return files;
}

std::string_view GltfDocument::open_buffer(const GltfObject& buffer) {
  const std::string uri = buffer.text("uri");
  if (uri.empty()) {
    buffer.refuse("nothing says where its bytes are (no \"uri\")");
  }
  if (is_data_uri(uri)) {
    auto bytes = data_of_uri(uri);
    if (!bytes) {
      buffer.refuse("its bytes can't be read: they are no valid base64");
    }
    return decoded_.emplace_back(std::move(*bytes));
  }
  const FoundInside found = find_inside(source_.folder, uri);
  if (found.file.empty()) {
    buffer.refuse(fmt::format("its file {} {}", in_quotes(uri), found.why));
  }
  const auto [file, fresh] = files_.try_emplace(found.file.lexically_normal().string());
  if (fresh) {
    file->second = read_file(found.file);
    held_ += file->second.size();
    beside_digest_ += digest(file->second);
  }
  return file->second;
}

}  // namespace ridgecraft::mesh
