// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/reading/threemf/package.hpp"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "base/printable.hpp"

namespace ridgecraft::mesh {
namespace {

/// Some three million triangles; no paper model is near it.
constexpr std::uint64_t largest_xml = std::uint64_t{256} << 20U;
constexpr std::uint64_t largest_picture = std::uint64_t{64} << 20U;
/// The tree of an XML text may take this much, 1 GiB.
constexpr std::uint64_t largest_tree = std::uint64_t{1} << 30U;
/// What pugixml takes for an element or a text, and for an attribute.
constexpr std::uint64_t node_size = 64;
constexpr std::uint64_t attribute_size = 40;

bool is_xml_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// An upper bound of the memory that the tree of an XML text takes.
std::uint64_t tree_size(std::string_view text) {
  std::uint64_t size = 0;
  bool after_tag = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '<') {
      size += i + 1 < text.size() && text[i + 1] == '/' ? 0 : node_size;
    } else if (c == '=') {
      size += attribute_size;
    } else if (after_tag && !is_xml_blank(c)) {
      size += node_size;
    }
    after_tag = c == '>' || (after_tag && is_xml_blank(c));
  }
  return size;
}

}  // namespace

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

std::string_view attribute(pugi::xml_node node, std::string_view name) {
  for (const pugi::xml_attribute a : node.attributes()) {
    if (local_name(a.name()) == name) {
      return a.value();
    }
  }
  return {};
}

std::string part_name(std::string_view name) {
  name.remove_prefix(std::min(name.find_first_not_of('/'), name.size()));
  return std::string(name);
}

ThreemfPackage::ThreemfPackage(const Source& source)
    : source_(source), archive_(source), root_(find_root()) {}

std::string ThreemfPackage::find_root() {
  const std::string relations = "_rels/.rels";
  const std::string usual = "3D/3dmodel.model";
  if (archive_.has(relations)) {
    const pugi::xml_document document = xml(relations);
    for (const pugi::xml_node relation : document.document_element()) {
      if (attribute(relation, "Type").ends_with("/3dmodel")) {
        const std::string target = part_name(attribute(relation, "Target"));
        if (archive_.has(target)) {
          return target;
        }
      }
    }
  }
  std::string part = archive_.has(usual) ? usual : archive_.first_ending_with(".model");
  if (part.empty()) {
    source_.refuse(ErrorKind::unreadable_input, "is no mesh but a ZIP archive; unpack it first");
  }
  return part;
}

pugi::xml_document ThreemfPackage::xml(const std::string& part) {
  std::string text = archive_.read(part, largest_xml);
  if (tree_size(text) > largest_tree) {
    source_.refuse(ErrorKind::unreadable_input,
                   fmt::format("is too large: its part {} has too many elements", in_quotes(part)));
  }
  pugi::xml_document document;
  const pugi::xml_parse_result result =
      document.load_buffer(text.data(), text.size(), pugi::parse_minimal | pugi::parse_escapes);
  if (result.status == pugi::status_out_of_memory) {
    throw std::bad_alloc();
  }
  if (!result) {
    source_.refuse(
        ErrorKind::unreadable_input,
        fmt::format("can't be read: at byte {} its part {} is no valid XML", result.offset, in_quotes(part)));
  }
  source_.context.check();
  return document;
}

std::string ThreemfPackage::bytes(const std::string& part) {
  return archive_.read(part, largest_picture);
}

}  // namespace ridgecraft::mesh
