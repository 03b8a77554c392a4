// SPDX-License-Identifier: GPL-3.0-or-later
// job_example MODEL PAGES.pdf: a whole job, as the program does it.
#include <fstream>
#include <iostream>

#include <ridgecraft/base/error.hpp>
#include <ridgecraft/export/export.hpp>
#include <ridgecraft/job/job.hpp>
#include <ridgecraft/mesh/mesh.hpp>

using namespace ridgecraft;

int main(int /*count*/, char** arguments) try {
  Context context;
  context.threads = 2;
  context.progress = [](std::string_view stage, double share) { std::cerr << stage << ' ' << share << '\n'; };
  job::Options options;
  options.size.largest_extent_mm = 120.0;
  options.paper = export_::parse_paper("A4");
  options.pieces = unfold::rules_of(unfold::PieceMode::parts);
  const mesh::Model model = mesh::read(arguments[1], {}, context);
  const job::Result made = job::run(model, options, context);
  std::ofstream(arguments[2], std::ios::binary)
      << export_::write_pdf(made.drawings, {"my program 1.0", model.name, model.digest});
  std::cout << made.nets.pieces.size() << " pieces on " << made.pages.count << " pages\n";
} catch (const Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
