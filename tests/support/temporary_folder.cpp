// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/temporary_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <unistd.h>

namespace ridgecraft::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() : TemporaryFolder(fs::temp_directory_path()) {}

TemporaryFolder::TemporaryFolder(const fs::path& parent) {
  std::string pattern = (parent / "ridgecraft-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("can't create a temporary folder");
  }
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::set<std::string> TemporaryFolder::names() const {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(path_)) {
    found.insert(entry.path().filename().string());
  }
  return found;
}

Contents contents(const fs::path& folder) {
  Contents found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) {
      found[fs::relative(entry.path(), folder).string()] = read_bytes(entry.path());
    }
  }
  return found;
}

fs::path memory() {
  const fs::path folder = "/dev/shm";
  return ::access(folder.c_str(), W_OK | X_OK) == 0 ? folder : fs::temp_directory_path();
}

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw std::runtime_error("can't read " + file.string());
  }
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out) {
    throw std::runtime_error("can't write " + file.string());
  }
}

}  // namespace ridgecraft::test
