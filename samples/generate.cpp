// SPDX-License-Identifier: GPL-3.0-or-later
// generate_samples FOLDER: writes every sample model. The files next to this source are what it writes.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "samples/samples.hpp"

int main(int argc, char** argv) {
  using namespace ridgecraft::samples;
  if (argc != 2) {
    std::fputs("usage: generate_samples FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const Sample& sample : all()) {
      write_model(sample.make(), std::filesystem::path(argv[1]) / sample.file);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_samples: %s\n", error.what());
    return 1;
  }
  return 0;
}
