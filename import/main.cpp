// SPDX-License-Identifier: GPL-3.0-or-later
// ridgecraft-import FORMAT: reads a model of that format from standard input by Assimp, and writes what is in
// it to standard output (mesh/reading/imported/stream.hpp). Not to be called by people: ridgecraft does,
// where it lets others read for it. Nothing here trusts Assimp: the system grants the process its two
// streams, memory and the time of day, and nothing else (seccomp), and it has little time and memory.
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <linux/close_range.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "import/scene_soup.hpp"
#include "mesh/reading/imported/stream.hpp"

namespace {

using ridgecraft::import::StreamWriter;
namespace stream = ridgecraft::mesh::imported;

constexpr rlim_t most_seconds = 60;
constexpr rlim_t most_memory = rlim_t{1} << 31U;

void limit(int resource, rlim_t value) {
  const rlimit limits{value, value};
  (void)setrlimit(static_cast<__rlimit_resource_t>(resource), &limits);
}

#if !defined(RIDGECRAFT_SANITIZED)
/// From here on the system refuses all calls but these. False where it can't be told so.
bool allow_little() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) {
    return false;
  }
  bool set = true;
  // Memory, threads' locks, the end, and what abort() needs.
  for (const int call :
       {SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(futex),
        SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(getrandom), SCMP_SYS(exit),
        SCMP_SYS(exit_group), SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
        SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(tgkill)}) {
    set = seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0) == 0 && set;
  }
  set =
      seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(read), 1, SCMP_A0(SCMP_CMP_EQ, STDIN_FILENO)) == 0 &&
      set;
  set = seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(write), 1, SCMP_A0(SCMP_CMP_EQ, STDOUT_FILENO)) ==
            0 &&
        set;
  set = seccomp_load(filter) == 0 && set;
  seccomp_release(filter);
  return set;
}
#endif

/// Assimp asks for files beside the model, which it has in memory: there are none.
class NoFiles final : public Assimp::IOSystem {
 public:
  [[nodiscard]] bool Exists(const char* /*file*/) const override { return false; }
  [[nodiscard]] char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* /*file*/, const char* /*mode*/) override { return nullptr; }
  void Close(Assimp::IOStream* /*file*/) override {}
};

std::string read_all() {
  std::string bytes;
  std::array<char, 65536> buffer{};
  for (ssize_t got = 1; got > 0;) {
    got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    bytes.append(buffer.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  }
  return bytes;
}

bool write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (put <= 0) {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return true;
}

std::string refusal(std::string_view reason) {
  StreamWriter out;
  out.words(stream::start);
  out.index(stream::kind_refusal);
  out.text(reason);
  out.words(stream::end);
  return out.take();
}

/// Leaves none but the importer of files with this suffix: what the others would make of the bytes is
/// nobody's wish.
void keep_only(Assimp::Importer& importer, const std::string& suffix) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* const about = importer.GetImporterInfo(i);
    const std::string suffixes = " " + std::string(about == nullptr ? "" : about->mFileExtensions) + " ";
    if (suffixes.find(" " + suffix + " ") == std::string::npos) {
      importer.UnregisterLoader(importer.GetImporter(i));
    }
  }
}

/// Without blanks before numbers of an XML file, which Assimp 5.2 takes for a mistake in some places
/// ("<color>  0.0 0.0 0.0 1.0</color>").
std::string without_blanks_before_numbers(const std::string& xml) {
  constexpr std::string_view blanks = " \t\r\n";
  std::string out;
  out.reserve(xml.size());
  for (std::size_t at = 0; at < xml.size();) {
    const std::size_t end = std::min(xml.find('>', at), xml.size() - 1) + 1;
    out.append(xml, at, end - at);
    at = end;
    const std::size_t next = xml.find_first_not_of(blanks, at);
    if (next != std::string::npos && std::string_view("0123456789.-+").find(xml[next]) != std::string::npos) {
      at = next;
    }
  }
  return out;
}

std::string imported(std::string bytes, const std::string& format) {
  std::string suffix = format;
  for (char& c : suffix) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (suffix == "dae") {
    bytes = without_blanks_before_numbers(bytes);
  }
  Assimp::Importer importer;
  keep_only(importer, suffix);
  importer.SetIOHandler(new NoFiles);  // the importer deletes it
  // Put together, Assimp 5.2 forgets that a PostRotation is taken back.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* const scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, suffix.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return refusal(importer.GetErrorString());
  }
  return ridgecraft::import::soup_stream(*scene, format);
}

}  // namespace

int main(int argc, char** argv) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CPU, most_seconds);
#if !defined(RIDGECRAFT_SANITIZED)
  limit(RLIMIT_AS, most_memory);  // a sanitizer's bookkeeping alone takes more, and it opens files
  limit(RLIMIT_NOFILE, 0);        // standard input and output are open already
  limit(RLIMIT_NPROC, 0);
#endif
  (void)prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (argc != 2) {
    return 2;
  }
#if !defined(RIDGECRAFT_SANITIZED)
  // What whoever started it had open is none of its business.
  (void)syscall(SYS_close_range, STDERR_FILENO + 1, ~0U, 0);
  if (!allow_little()) {
    return 3;
  }
#endif
  std::string answer;
  try {
    answer = imported(read_all(), argv[1]);
  } catch (const std::bad_alloc&) {
    answer = refusal("it needs more memory than its reader may have");
  } catch (const std::exception& error) {
    answer = refusal(error.what());
  }
  // Nothing is to be put in order after that, least of all by Assimp.
  std::_Exit(write_all(answer) ? 0 : 1);
}
