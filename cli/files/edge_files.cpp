// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/files/edge_files.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/digest.hpp"
#include "base/error.hpp"
#include "cli/files/text_lines.hpp"
#include "mesh/model/file_format.hpp"
#include "mesh/reading/read_file.hpp"

namespace ridgecraft::cli {
namespace {

[[noreturn]] void refuse_line(const std::string& file, std::size_t line, std::string_view reason) {
  throw Error(ErrorKind::unreadable_input, fmt::format("{}, line {}: {}", file, line, reason), file);
}

std::uint32_t number_of(std::string_view word, const std::string& file, std::size_t line) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    refuse_line(file, line, fmt::format("'{}' is no number of a point", word));
  }
  return value;
}

/// Pairs of points, one pair a line.
job::EdgeList pairs_in(const EdgeFile& edges, const mesh::Model& model) {
  const std::uint32_t first = mesh::first_point_number(model.format);
  job::EdgeList list{{}, digest(edges.bytes)};
  for_each_line(edges.bytes, [&](const std::vector<std::string_view>& words, std::size_t line) {
    std::vector<std::uint32_t> pair;
    for (const std::string_view word : words) {
      pair.push_back(number_of(word, edges.name, line));
    }
    if (pair.size() != 2) {
      refuse_line(edges.name, line, "two numbers of points are needed");
    }
    for (const std::uint32_t number : pair) {
      if (number < first || number - first >= model.file_points.size()) {
        refuse_line(edges.name, line,
                    fmt::format("the model has no point {} (its points are {} to {})", number, first,
                                model.file_points.size() - 1 + first));
      }
    }
    list.edges.push_back({pair[0] - first, pair[1] - first});
  });
  return list;
}

}  // namespace

EdgeFiles read_edge_files(const EdgeArguments& edges) {
  const auto read = [](const std::string& name) -> std::optional<EdgeFile> {
    if (name.empty()) {
      return std::nullopt;
    }
    // Read before the aggregate begins: g++ 12 destroys its members twice where one of them throws.
    std::string bytes = mesh::read_file(name);
    return EdgeFile{name, std::move(bytes)};
  };
  return {read(edges.cuts), read(edges.keep), read(edges.from)};
}

std::vector<InputFile> input_files(const EdgeArguments& edges) {
  return {{"--from", edges.from}, {"--cuts", edges.cuts}, {"--keep", edges.keep}};
}

job::EdgeRequests requests_of(const EdgeFiles& files, const mesh::Model& model) {
  job::EdgeRequests requests;
  if (files.cuts) {
    requests.cut = pairs_in(*files.cuts, model);
  }
  if (files.keep) {
    requests.keep = pairs_in(*files.keep, model);
  }
  if (files.from) {
    requests.from = job::OldNets{files.from->name, files.from->bytes};
  }
  return requests;
}

}  // namespace ridgecraft::cli
