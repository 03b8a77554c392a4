// SPDX-License-Identifier: GPL-3.0-or-later
// The report as JSON, with the keys of the contract's section 5 in its order.
#include "verify/report/report.hpp"

#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace ridgecraft::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// The value of a figure, or null where there are none.
template <typename T>
OrderedJson value(const std::optional<Figures>& figures, T Figures::*member) {
  return figures ? OrderedJson((*figures).*member) : OrderedJson();
}

std::string plural(const std::string& name) {
  return name == "vertex" ? "vertices" : name + "s";
}

/// An index stands under its name; several of one kind are a list under the plural.
OrderedJson fault_json(const Fault& fault) {
  OrderedJson json;
  json["promise"] = static_cast<int>(fault.promise);
  json["message"] = fault.message;
  std::map<std::string, std::vector<long long>> by_name;
  for (const auto& [name, index] : fault.indices) {
    by_name[name].push_back(index);
  }
  for (const auto& [name, list] : by_name) {
    if (list.size() == 1) {
      json[name] = list.front();
    } else {
      json[plural(name)] = list;
    }
  }
  return json;
}

/// What was looked at besides the nets themselves; keys are there only where it was.
void add_beside_nets(const Report& report, OrderedJson& json) {
  if (report.folding) {
    json["pieces_to_fold_with_care"] = report.folding->with_care;
    json["pieces_not_folded"] = report.folding->not_tried;
  }
  if (report.model) {
    OrderedJson& model = json["against_model"];
    model["deviation_mm"] = report.model->deviation_mm;
    model["allowed_mm"] = report.model->allowed_mm ? OrderedJson(*report.model->allowed_mm) : OrderedJson();
    model["mm_per_unit"] = report.model->mm_per_unit;
    model["same_file"] = report.model->same_file ? OrderedJson(*report.model->same_file) : OrderedJson();
  }
  if (report.printed) {
    OrderedJson& printed = json["printed"];
    printed["pages"] = report.printed->pages;
    printed["pages_not_given"] = report.printed->pages_not_given;
    printed["faulty"] = report.printed->faulty;
    printed["max_error_mm"] = report.printed->max_error_mm;
  }
}

}  // namespace

std::string to_json(const Report& report) {
  const std::optional<Figures>& figures = report.figures;
  OrderedJson json;
  json["faces"] = value(figures, &Figures::faces);
  json["pieces"] = value(figures, &Figures::pieces);
  json["pages"] = value(figures, &Figures::pages);
  json["overlaps"] = value(figures, &Figures::overlaps);
  json["tab_overlaps"] = value(figures, &Figures::tab_overlaps);
  json["max_length_error_mm"] = value(figures, &Figures::max_length_error_mm);
  json["max_penetration_mm"] = value(figures, &Figures::max_penetration_mm);
  json["missing_faces"] = value(figures, &Figures::missing_faces);
  json["double_faces"] = value(figures, &Figures::double_faces);
  json["outside_page"] = value(figures, &Figures::outside_page);
  json["bad_joins"] = value(figures, &Figures::bad_joins);
  json["joins"] = value(figures, &Figures::joins);
  json["joins_without_tab"] = value(figures, &Figures::joins_without_tab);
  json["max_fold_error_deg"] = value(figures, &Figures::max_fold_error_deg);
  json["max_refold_error_mm"] = value(figures, &Figures::max_refold_error_mm);
  json["cut_mm"] = value(figures, &Figures::cut_mm);
  json["fold_mm"] = value(figures, &Figures::fold_mm);
  json["tabs"] = value(figures, &Figures::tabs);
  add_beside_nets(report, json);
  json["faults"] = OrderedJson::array();
  for (const Fault& fault : report.faults) {
    json["faults"].push_back(fault_json(fault));
  }
  OrderedJson left;
  for (std::size_t promise = 0; promise < promise_count; ++promise) {
    if (report.faults_not_listed[promise] > 0) {
      left[std::to_string(promise)] = report.faults_not_listed[promise];
    }
  }
  if (!left.is_null()) {
    json["faults_not_listed"] = left;
  }
  // Names of pieces come from the file and may hold anything.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace ridgecraft::verify
