// SPDX-License-Identifier: GPL-3.0-or-later
// DXF of one page (Autodesk, DXF reference, releases 12 and 2000): ASCII, millimetres, y up, straight lines
// and closed polylines on a layer for each operation. No blocks, splines, texts or hatches, as cutters and
// laser shops ask. Written by hand: the library at hand leaves out the owners of its tables, which readers
// repair.
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "export/formats/text_file.hpp"
#include "export/formats/write.hpp"
#include "export/machine/operations.hpp"

namespace ridgecraft::export_ {
namespace {

struct DxfLayer {
  std::string_view name;
  int color;  ///< AutoCAD colour index
};

/// By Operation.
constexpr std::array<DxfLayer, operation_count> layers{{{"REGMARKS", 8},
                                                        {"ENGRAVE", 7},
                                                        {"MOUNTAIN", 5},
                                                        {"VALLEY", 6},
                                                        {"TAB", 3},
                                                        {"CUT_INNER", 30},
                                                        {"CUT", 1}}};

/// One value of one layer, where nothing may tell operations apart.
constexpr DxfLayer only_layer{"0", 7};

/// Handles that others point to; those of entities follow.
enum Handle : unsigned {
  block_records = 0x1,
  layer_table = 0x2,
  style_table = 0x3,
  linetype_table = 0x5,
  view_table = 0x6,
  ucs_table = 0x7,
  viewport_table = 0x8,
  application_table = 0x9,
  dimension_table = 0xA,
  root_dictionary = 0xC,
  group_dictionary = 0xD,
  model_space = 0x1F,
  paper_space = 0x1B,
  first_free = 0x40
};

class DxfWriter {
 public:
  DxfWriter(const Drawing& page, const Mark& mark, DxfKind kind, const PathRules& rules)
      : page_(page), mark_(mark), kind_(kind), paths_(machine_paths(page, rules)) {
    if (kind == DxfKind::plain) {
      // Nothing tells there that marks aren't cut.
      std::erase_if(paths_, [](const Path& path) { return path.operation == Operation::registration; });
    }
  }

  std::string write() {
    // The handle after the last one stands in the header, before any of them.
    entities();
    std::string entities_text = std::move(out_);
    out_.clear();
    comment(printable_utf8(mark_.producer + " " + mark_word(mark_)));
    header();
    if (!is_r12()) {
      section("CLASSES");
      end_section();
    }
    tables();
    blocks();
    out_ += entities_text;
    if (!is_r12()) {
      objects();
    }
    pair(0, "EOF");
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_r12() const { return kind_ != DxfKind::r2000; }
  [[nodiscard]] const DxfLayer& layer_of(const Path& path) const {
    return kind_ == DxfKind::plain ? only_layer : layers[static_cast<std::size_t>(path.operation)];
  }

  /// As wide as three digits.
  void code_line(int code) {
    const fmt::format_int digits(code);
    out_.append(3 - std::min<std::size_t>(digits.size(), 3), ' ');
    out_.append(digits.data(), digits.size());
    out_ += '\n';
  }
  void pair(int code, std::string_view value) {
    code_line(code);
    out_ += value;
    out_ += '\n';
  }
  void pair(int code, int value) { fmt::format_to(std::back_inserter(out_), "{:>3}\n{:>6}\n", code, value); }
  void handle(int code, unsigned value) {
    fmt::format_to(std::back_inserter(out_), "{:>3}\n{:X}\n", code, value);
  }
  /// At least one digit behind the point, at most four.
  void real(int code, double value) {
    std::string text = four_decimals(value);
    text.erase(std::max(text.find_last_not_of('0'), text.find('.') + 1) + 1);
    pair(code, text);
  }
  void point(int code, Vec2 p) {
    real(code, p.x);
    real(code + 10, p.y);
  }
  void point3(int code, Vec2 p) {
    point(code, p);
    real(code + 20, 0.0);
  }
  void comment(std::string_view text) { pair(999, text); }
  void section(std::string_view name) {
    pair(0, "SECTION");
    pair(2, name);
  }
  void end_section() { pair(0, "ENDSEC"); }

  void header() {
    section("HEADER");
    pair(9, "$ACADVER");
    pair(1, is_r12() ? "AC1009" : "AC1015");
    if (!is_r12()) {
      pair(9, "$HANDSEED");
      handle(5, next_handle_);
      pair(9, "$INSUNITS");
      pair(70, 4);
      pair(9, "$MEASUREMENT");
      pair(70, 1);
    }
    pair(9, "$EXTMIN");
    point3(10, {});
    pair(9, "$EXTMAX");
    point3(10, page_.size);
    pair(9, "$LIMMIN");
    point(10, {});
    pair(9, "$LIMMAX");
    point(10, page_.size);
    end_section();
  }

  void table(std::string_view name, Handle table_handle, int entries) {
    pair(0, "TABLE");
    pair(2, name);
    if (!is_r12()) {
      handle(5, table_handle);
      handle(330, 0);
      pair(100, "AcDbSymbolTable");
    }
    pair(70, entries);
    if (!is_r12() && table_handle == dimension_table) {
      pair(100, "AcDbDimStyleTable");
    }
  }
  void end_table() { pair(0, "ENDTAB"); }

  /// Everything that a record of a table begins with.
  void record(std::string_view type, Handle table_handle, unsigned own, std::string_view kind,
              std::string_view name) {
    pair(0, type);
    if (!is_r12()) {
      handle(table_handle == dimension_table ? 105 : 5, own);
      handle(330, table_handle);
      pair(100, "AcDbSymbolTableRecord");
      pair(100, kind);
    }
    pair(2, name);
    if (table_handle != block_records) {
      pair(70, 0);
    }
  }

  void viewport() {
    record("VPORT", viewport_table, 0x21, "AcDbViewportTableRecord", "*ACTIVE");
    point(10, {});
    point(11, {1.0, 1.0});
    point(12, 0.5 * page_.size);
    point(13, {});
    point(14, {10.0, 10.0});
    point(15, {10.0, 10.0});
    point(16, {});
    real(36, 1.0);
    point(17, {});
    real(37, 0.0);
    real(40, page_.size.y);
    real(41, page_.size.x / page_.size.y);
    real(42, 50.0);
    real(43, 0.0);
    real(44, 0.0);
    real(50, 0.0);
    real(51, 0.0);
    pair(71, 0);
    pair(72, 100);
    pair(73, 1);
    pair(74, 3);
    pair(75, 0);
    pair(76, 0);
    pair(77, 0);
    pair(78, 0);
  }

  void linetype(unsigned own, std::string_view name, std::string_view description) {
    record("LTYPE", linetype_table, own, "AcDbLinetypeTableRecord", name);
    pair(3, description);
    pair(72, 65);
    pair(73, 0);
    real(40, 0.0);
  }

  void layer(unsigned own, const DxfLayer& layer) {
    record("LAYER", layer_table, own, "AcDbLayerTableRecord", layer.name);
    pair(62, layer.color);
    pair(6, "CONTINUOUS");
  }

  void tables() {
    section("TABLES");
    table("VPORT", viewport_table, 1);
    viewport();
    end_table();
    table("LTYPE", linetype_table, is_r12() ? 1 : 3);
    if (!is_r12()) {
      linetype(0x14, "BYBLOCK", "");
      linetype(0x15, "BYLAYER", "");
    }
    linetype(0x16, "CONTINUOUS", "Solid line");
    end_table();
    const bool by_operation = kind_ != DxfKind::plain;
    table("LAYER", layer_table, by_operation ? operation_count + 1 : 1);
    layer(0x10, only_layer);
    for (std::size_t i = 0; by_operation && i < layers.size(); ++i) {
      layer(static_cast<unsigned>(0x30 + i), layers[i]);
    }
    end_table();
    table("STYLE", style_table, 1);
    record("STYLE", style_table, 0x11, "AcDbTextStyleTableRecord", "STANDARD");
    real(40, 0.0);
    real(41, 1.0);
    real(50, 0.0);
    pair(71, 0);
    real(42, 2.5);
    pair(3, "txt");
    pair(4, "");
    end_table();
    table("VIEW", view_table, 0);
    end_table();
    table("UCS", ucs_table, 0);
    end_table();
    table("APPID", application_table, 1);
    record("APPID", application_table, 0x12, "AcDbRegAppTableRecord", "ACAD");
    end_table();
    table("DIMSTYLE", dimension_table, 1);
    record("DIMSTYLE", dimension_table, 0x27, "AcDbDimStyleTableRecord", "STANDARD");
    end_table();
    if (!is_r12()) {
      table("BLOCK_RECORD", block_records, 2);
      record("BLOCK_RECORD", block_records, model_space, "AcDbBlockTableRecord", "*Model_Space");
      record("BLOCK_RECORD", block_records, paper_space, "AcDbBlockTableRecord", "*Paper_Space");
      end_table();
    }
    end_section();
  }

  void block(Handle of, unsigned begin, unsigned end, std::string_view name) {
    pair(0, "BLOCK");
    handle(5, begin);
    handle(330, of);
    pair(100, "AcDbEntity");
    pair(8, only_layer.name);
    pair(100, "AcDbBlockBegin");
    pair(2, name);
    pair(70, 0);
    point3(10, {});
    pair(3, name);
    pair(1, "");
    pair(0, "ENDBLK");
    handle(5, end);
    handle(330, of);
    pair(100, "AcDbEntity");
    pair(8, only_layer.name);
    pair(100, "AcDbBlockEnd");
  }

  void blocks() {
    section("BLOCKS");
    if (!is_r12()) {
      block(model_space, 0x20, 0x22, "*Model_Space");
      block(paper_space, 0x1C, 0x1D, "*Paper_Space");
    }
    end_section();
  }

  void entities() {
    section("ENTITIES");
    for (const Path& path : paths_) {
      if (path.closed && kind_ != DxfKind::plain) {
        polyline(path);
        continue;
      }
      for (std::size_t i = 1; i < path.points.size(); ++i) {
        line(path, path.points[i - 1], path.points[i]);
      }
      if (path.closed) {
        line(path, path.points.back(), path.points.front());
      }
    }
    end_section();
  }

  void entity(std::string_view type, std::string_view kind, const Path& path) {
    pair(0, type);
    if (!is_r12()) {
      handle(5, next_handle_++);
      handle(330, model_space);
      pair(100, "AcDbEntity");
    }
    pair(8, layer_of(path).name);
    if (!is_r12()) {
      pair(100, kind);
    }
  }

  void line(const Path& path, Vec2 from, Vec2 to) {
    entity("LINE", "AcDbLine", path);
    point3(10, from);
    point3(11, to);
  }

  void polyline(const Path& path) {
    constexpr int is_closed = 1;
    if (!is_r12()) {
      entity("LWPOLYLINE", "AcDbPolyline", path);
      pair(90, static_cast<int>(path.points.size()));
      pair(70, is_closed);
      for (const Vec2 p : path.points) {
        point(10, p);
      }
      return;
    }
    entity("POLYLINE", "", path);
    pair(66, 1);
    pair(70, is_closed);
    point3(10, {});
    for (const Vec2 p : path.points) {
      entity("VERTEX", "", path);
      point3(10, p);
    }
    entity("SEQEND", "", path);
  }

  void objects() {
    section("OBJECTS");
    pair(0, "DICTIONARY");
    handle(5, root_dictionary);
    handle(330, 0);
    pair(100, "AcDbDictionary");
    pair(281, 1);
    pair(3, "ACAD_GROUP");
    handle(350, group_dictionary);
    pair(0, "DICTIONARY");
    handle(5, group_dictionary);
    handle(330, root_dictionary);
    pair(100, "AcDbDictionary");
    pair(281, 1);
    end_section();
  }

  const Drawing& page_;
  const Mark& mark_;
  DxfKind kind_;
  std::vector<Path> paths_;
  unsigned next_handle_ = first_free;
  std::string out_;
};

}  // namespace

std::string write_dxf(const Drawing& page, const Mark& mark, DxfKind kind, const PathRules& rules) {
  return DxfWriter(page, mark, kind, rules).write();
}

}  // namespace ridgecraft::export_
