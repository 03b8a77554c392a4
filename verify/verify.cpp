// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/verify.hpp"

#include <array>
#include <new>
#include <stdexcept>
#include <utility>

#include "verify/checks/checks.hpp"
#include "verify/pages/check_pages.hpp"

namespace ridgecraft::verify {
namespace {

Report not_in_form(std::string message) {
  Report report;
  report.faults.push_back({Promise::form, std::move(message), {}});
  return report;
}

Report check(const File& file, const Options& options, const Context& context, const Against& against) {
  const Relations relations = relate(file);
  const Case given{file, relations, context};
  Findings findings(options);
  findings.figures().faces = file.faces.faces();
  findings.figures().pieces = file.pieces.size();
  findings.figures().pages = file.pages.size();
  constexpr std::array steps = {check_lengths,       check_coverage,  check_overlap,
                                check_bounds,        check_patches,   check_joins,
                                check_tabs,          check_slits,     check_paper_behind_tabs,
                                check_refold,        measure_cuts,    check_statements,
                                check_chains,        check_bends,     check_fold_order,
                                check_equal_pieces,  check_assembly,  check_glue,
                                count_narrow_pieces, count_thin_necks};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    context.check();
    context.report("verify", static_cast<double>(i + 1) / static_cast<double>(steps.size() + 1));
    steps[i](given, findings);
  }
  if (options.folding) {
    check_fold_motion(given, findings);
  }
  if (against.model != nullptr) {
    check_model(given, *against.model, findings);
  }
  if (!against.printed.empty()) {
    check_pages(given, against.printed, findings);
  }
  return findings.take();
}

}  // namespace

Report verify(std::string_view bytes, const Options& options, const Context& context,
              const Against& against) {
  context.check();
  context.report("verify", 0.0);
  Report report;
  try {
    report = check(read_file(bytes), options, context, against);
  } catch (const NotInForm& fault) {
    report = not_in_form(fault.message);
  } catch (const std::bad_alloc&) {
    report = not_in_form("the file needs more memory than there is");
  } catch (const std::length_error&) {
    report = not_in_form("the file needs more memory than there is");
  }
  context.report("verify", 1.0);
  return report;
}

}  // namespace ridgecraft::verify
