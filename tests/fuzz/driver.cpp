#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mutation.hpp"

/// Runs a fuzz target on its seeds, and on what chance makes of them: the same at every run. Any compiler
/// will do. tools/fuzz searches on, led by the code that inputs reach.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = laneloom::Mutation::Bytes;

constexpr std::size_t kTruncations = 50, kMutations = 400;  // of each seed

/// All inputs of one target.
class Run {
 public:
  Run(std::string target, std::vector<Bytes> seeds)
      : input_(target + ".input"), mutation_(std::move(seeds)) {}
  ~Run() { std::filesystem::remove(input_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void seeds_as_they_are() {
    for (const Bytes& seed : mutation_.originals()) try_one(seed);
  }
  void truncated() {
    for (const Bytes& seed : mutation_.originals())
      for (std::size_t i = 0; i < kTruncations; ++i)
        try_one({seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(seed.size() * i / kTruncations)});
  }
  void mutated() {
    for (const Bytes& seed : mutation_.originals()) {
      for (std::size_t i = 0; i < kMutations; ++i) {
        Bytes bytes = seed;
        mutation_.damage(bytes);
        try_one(bytes);
      }
    }
  }
  std::size_t count() const { return count_; }

 private:
  /// The copy takes just its size, so that a sanitizer sees what is read beyond. The input stays in its file
  /// if it ends the program.
  void try_one(const Bytes& bytes) {
    const Bytes exact(bytes);
    std::ofstream(input_, std::ios::binary)
        .write(reinterpret_cast<const char*>(exact.data()), static_cast<std::streamsize>(exact.size()));
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
    ++count_;
  }

  std::filesystem::path input_;
  laneloom::Mutation mutation_;
  std::size_t count_ = 0;
};

/// A file, or those of a folder.
std::vector<Bytes> read_seeds(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{path};
  if (std::filesystem::is_directory(path))
    files.assign(std::filesystem::directory_iterator(path), std::filesystem::directory_iterator());
  std::ranges::sort(files);
  std::vector<Bytes> seeds;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file.string() + ": can not be read");
    seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  if (seeds.empty()) throw std::runtime_error(path.string() + ": there are no seeds");
  return seeds;
}

/// A reader that believes any length fails, instead of taking all memory. Sanitizers need terabytes of
/// addresses.
void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  constexpr rlimit kLimit{1UL << 31U, 1UL << 31U};
  setrlimit(RLIMIT_AS, &kLimit);
#endif
}

}  // namespace

/// fuzz_TARGET FOLDER: its seeds, and what damages them. fuzz_TARGET FILE: this one as it is.
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER|FILE\n", *argv);
    return 2;
  }
  const std::string target = std::filesystem::path(*argv).filename().string();
  std::vector<Bytes> seeds = read_seeds(argv[1]);
  limit_memory();
  if (!std::filesystem::is_directory(argv[1]))
    return LLVMFuzzerTestOneInput(seeds[0].data(), seeds[0].size());
  std::printf("%s: should it fail, run it with the file %s.input\n", target.c_str(), target.c_str());
  std::fflush(stdout);
  Run run(target, std::move(seeds));
  run.seeds_as_they_are();
  run.truncated();
  run.mutated();
  std::printf("%s: %zu inputs, no finding\n", target.c_str(), run.count());
  return 0;
}
