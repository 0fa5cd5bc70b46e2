// Runs a target without libFuzzer: first every seed, then seeds that were changed at random.
//
//   fuzz_case SEEDS [--seconds S] [--seed N] [INPUT...]
//
// An input that ends the program, lasts longer than 5 s or takes more than 2 GB is left in crash-TARGET and named.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Input = std::string;

Input current;
std::string crash_file;
constexpr unsigned longest_seconds = 5;

// Called in signal handlers and at the end of all hope: no more than open and write.
void leave(const char* what) {
  std::FILE* const file = std::fopen(crash_file.c_str(), "wb");
  if (file) {
    std::fwrite(current.data(), 1, current.size(), file);
    std::fclose(file);
  }
  std::fprintf(stderr, "%s; the input is left in %s\n", what, crash_file.c_str());
  std::_Exit(1);
}

extern "C" void on_signal(int signal) {
  leave(signal == SIGALRM ? "an input lasts too long" : "an input ends the program");
}

void call(const Input& input) {
  current = input;
  ::alarm(longest_seconds);
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current.data()), current.size());
  } catch (const std::exception& error) {
    leave(error.what());
  }
  ::alarm(0);
}

Input changed(const std::vector<Input>& seeds, std::mt19937_64& random) {
  static const std::vector<std::string> words = {"-1",
                                                 "0",
                                                 "1e308",
                                                 "nan",
                                                 "inf",
                                                 "1e-308",
                                                 "\"",
                                                 "'''",
                                                 "[",
                                                 "]]",
                                                 "{",
                                                 "}",
                                                 ",",
                                                 "=",
                                                 "\n",
                                                 "#",
                                                 "\\u0000",
                                                 ".",
                                                 "true",
                                                 "[[",
                                                 "99999999999999999999",
                                                 "mm",
                                                 " deg",
                                                 " rpm",
                                                 "um",
                                                 "degC",
                                                 "\xff\xfe",
                                                 "\t",
                                                 "base = \"input.toml\"\n"};
  const auto up_to = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
  Input text = seeds[up_to(seeds.size())];
  for (std::size_t k = 1 + up_to(6); k > 0; --k) {
    const std::size_t at = up_to(text.size() + 1), n = std::min<std::size_t>(up_to(40), text.size() - at);
    switch (up_to(8)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1u << up_to(8)));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      case 2:
        text.erase(at, n);
        break;
      case 3:
        text.insert(at, text.substr(up_to(text.size() + 1), n));
        break;
      case 4:
        text.insert(at, words[up_to(words.size())]);
        break;
      case 5:
        text.replace(at, n, words[up_to(words.size())]);
        break;
      case 6:
        text.resize(at);
        break;
      default: {
        const Input& other = seeds[up_to(seeds.size())];
        text = text.substr(0, at) + other.substr(std::min(at, other.size()));
      }
    }
  }
  return text;
}

Input content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

int main(int n_arguments, char** arguments) {
  double seconds = 0.;
  std::uint64_t seed = 1;
  std::vector<fs::path> files;
  for (int i = 1; i < n_arguments; ++i) {
    const std::string word = arguments[i];
    if (word == "--seconds" && i + 1 < n_arguments)
      seconds = std::atof(arguments[++i]);
    else if (word == "--seed" && i + 1 < n_arguments)
      seed = std::strtoull(arguments[++i], nullptr, 10);
    else if (fs::is_directory(word))
      for (const auto& entry : fs::directory_iterator(word)) files.push_back(entry.path());
    else
      files.emplace_back(word);
  }
  std::sort(files.begin(), files.end());
  crash_file = "crash-" + fs::path(arguments[0]).filename().string();
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL, SIGALRM}) std::signal(signal, on_signal);
#if !defined(__SANITIZE_ADDRESS__)
  const rlimit memory{std::uint64_t{2} << 30u, std::uint64_t{2} << 30u};
  setrlimit(RLIMIT_AS, &memory);
#endif

  std::vector<Input> seeds;
  for (const auto& file : files) seeds.push_back(content_of(file));
  if (seeds.empty()) {
    std::fprintf(stderr, "no seeds\n");
    return 2;
  }
  for (const auto& input : seeds) call(input);
  std::mt19937_64 random(seed);
  long n = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (; std::chrono::steady_clock::now() < end; ++n) call(changed(seeds, random));
  std::printf("%zu seeds and %ld changed inputs: no crash, no hang\n", seeds.size(), n);
  return 0;
}
