// Checkpoints: complete or absent, never half; and never those of another case.

#include "io/checkpoint.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace {

using namespace rotordrop;
namespace fs = std::filesystem;

class CheckpointTest : public testing::Test {
 protected:
  CheckpointTest() {
    std::string pattern = (fs::temp_directory_path() / "rotordrop-checkpoint-XXXXXX").string();
    directory = ::mkdtemp(pattern.data());
  }
  ~CheckpointTest() override {
    std::error_code ignored;
    fs::remove_all(directory, ignored);
  }

  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path directory;
};

Checkpoint example(double time = 0.125) {
  Checkpoint checkpoint;
  checkpoint.time = time;
  checkpoint.state = {1 / 3., -0., std::numeric_limits<double>::denorm_min(), 5e300};
  checkpoint.extras = {{"window/TB2", {0.1, 0.2}}, {"integrator", {}}, {"last step", {1e-6}}};
  checkpoint.parameter_digest = "9f86d081884c7d65";
  checkpoint.entry_names = {"rotor/y", "rotor/velocity y", "TB2/inner ring spin", "energy/TB2 rub heat"};
  return checkpoint;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void replace_content(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(CheckpointTest, ReturnsEveryBitOfWhatWasWritten) {
  const Checkpoint written = example();
  const Checkpoint read = read_checkpoint(write_checkpoint(directory, written));
  EXPECT_EQ(read, written);
  EXPECT_TRUE(std::signbit(read.state[1]));
  EXPECT_EQ(files(), (std::vector<std::string>{"checkpoint-000001.h5"}));
}

TEST_F(CheckpointTest, AnEmptyStateIsACheckpointToo) {
  EXPECT_EQ(read_checkpoint(write_checkpoint(directory, Checkpoint{})), Checkpoint{});
}

TEST_F(CheckpointTest, MakesItsDirectory) {
  write_checkpoint(directory / "a" / "checkpoints", example());
  EXPECT_TRUE(newest_valid_checkpoint(directory / "a" / "checkpoints").checkpoint.has_value());
}

TEST_F(CheckpointTest, KeepsTheNewestAndCountsOn) {
  for (int i = 0; i < 12; ++i) write_checkpoint(directory, example(i), 3);
  EXPECT_EQ(files(),
            (std::vector<std::string>{"checkpoint-000010.h5", "checkpoint-000011.h5", "checkpoint-000012.h5"}));
  write_checkpoint(directory, example(12), 1);
  EXPECT_EQ(files(), (std::vector<std::string>{"checkpoint-000013.h5"}));
  EXPECT_EQ(newest_valid_checkpoint(directory).checkpoint->time, 12);
}

TEST_F(CheckpointTest, LeavesOtherFilesAlone) {
  for (const char* name : {"checkpoint-final.h5", "checkpoint-.h5", "checkpoint-1.h5.bak", "results.h5"})
    replace_content(directory / name, "mine");
  for (int i = 0; i < 5; ++i) write_checkpoint(directory, example(i), 1);
  EXPECT_EQ(files().size(), 5U);
  EXPECT_TRUE(newest_valid_checkpoint(directory).skipped.empty());
}

TEST_F(CheckpointTest, FindsNothingWhereNothingIs) {
  EXPECT_FALSE(newest_valid_checkpoint(directory).checkpoint.has_value());
  EXPECT_FALSE(newest_valid_checkpoint(directory / "missing").checkpoint.has_value());
}

TEST_F(CheckpointTest, NoticesEveryPlaceWhereAFileMayBeCutOff) {
  const fs::path path = write_checkpoint(directory, example());
  const std::string whole = content(path);
  for (std::size_t size = 0; size < whole.size(); size += (size < 20 || size + 60 > whole.size() ? 1 : 331)) {
    replace_content(path, whole.substr(0, size));
    ASSERT_THROW((void)read_checkpoint(path), InputError) << size << " of " << whole.size() << " bytes";
  }
}

TEST_F(CheckpointTest, NoticesEveryChangedByte) {
  const fs::path path = write_checkpoint(directory, example());
  const std::string whole = content(path);
  for (std::size_t i = 0; i + 1 < whole.size(); i += 41) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x20);
    replace_content(path, changed);
    ASSERT_THROW((void)read_checkpoint(path), InputError) << "byte " << i;
  }
}

TEST_F(CheckpointTest, SkipsDamagedOnesAndNamesThem) {
  for (int i = 0; i < 3; ++i) write_checkpoint(directory, example(i));
  const fs::path newest = directory / "checkpoint-000003.h5";
  replace_content(newest, content(newest).substr(0, 1000));
  replace_content(directory / "checkpoint-000002.h5", "");
  const FoundCheckpoint found = newest_valid_checkpoint(directory);
  ASSERT_TRUE(found.checkpoint.has_value());
  EXPECT_EQ(found.checkpoint->time, 0);
  EXPECT_EQ(found.path, directory / "checkpoint-000001.h5");
  ASSERT_EQ(found.skipped.size(), 2U);
  EXPECT_NE(found.skipped[0].find("checkpoint-000003.h5: "), std::string::npos) << found.skipped[0];
}

TEST_F(CheckpointTest, AKilledWriterLeavesAWholeCheckpoint) {
  for (int attempt = 0; attempt < 4; ++attempt) {
    const pid_t writer = ::fork();
    if (writer == 0) {
      Checkpoint large = example();
      large.state.assign(50000, 1.5);
      large.entry_names.assign(50000, "n");
      for (int i = 0;; ++i) {
        large.time = i;
        write_checkpoint(directory, large, 2);
      }
    }
    for (int i = 0; i < 4000 && !newest_valid_checkpoint(directory).checkpoint; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(10 + 7 * attempt));
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    const FoundCheckpoint found = newest_valid_checkpoint(directory);
    ASSERT_TRUE(found.checkpoint.has_value());
    EXPECT_EQ(found.checkpoint->state.size(), 50000U);
    EXPECT_TRUE(found.skipped.empty()) << "what has its name is whole: " << found.skipped.front();
  }
  write_checkpoint(directory, example(), 1);
  EXPECT_EQ(files().size(), 1U) << "the next writer has used up what the killed one left";
}

TEST_F(CheckpointTest, RefusesOtherParametersAndSaysWhatToDo) {
  const auto message = message_of([] { require_same_case("c.h5", example(), "0000", example().entry_names); });
  EXPECT_NE(message.find("other parameters (digest 9f86d081884c7d65; this case has 0000)"), std::string::npos)
      << message;
}

TEST_F(CheckpointTest, NamesTheParametersThatDifferWhereTheyAreKnown) {
  const auto message = message_of(
      [] { require_same_case("c.h5", example(), "0000", example().entry_names, [] { return "a.b (1, now 2)"; }); });
  EXPECT_NE(message.find("other parameters: a.b (1, now 2)."), std::string::npos) << message;
  EXPECT_EQ(message.find("digest"), std::string::npos) << message;
}

TEST_F(CheckpointTest, NamesTheEntriesThatDiffer) {
  auto names = example().entry_names;
  names[2] = "TB3/inner ring spin";
  names.emplace_back("TB3/cage angle");
  const auto message = message_of([&] { require_same_case("c.h5", example(), example().parameter_digest, names); });
  EXPECT_NE(message.find("its state has 4 entries, that of this case 5"), std::string::npos) << message;
  EXPECT_NE(message.find("Only in the checkpoint: \"TB2/inner ring spin\"."), std::string::npos) << message;
  EXPECT_NE(message.find("Only in this case: \"TB3/cage angle\", \"TB3/inner ring spin\"."), std::string::npos)
      << message;
}

TEST_F(CheckpointTest, NamesTheFirstEntryWhoseOrderDiffers) {
  auto names = example().entry_names;
  std::swap(names[1], names[2]);
  const auto message = message_of([&] { require_same_case("c.h5", example(), example().parameter_digest, names); });
  EXPECT_NE(
      message.find("order differs from entry 1 on: \"rotor/velocity y\" in the checkpoint, \"TB2/inner ring spin\""),
      std::string::npos)
      << message;
}

TEST_F(CheckpointTest, ReportsParametersAndEntriesTogetherAndAcceptsTheSameCase) {
  EXPECT_NO_THROW(require_same_case("c.h5", example(), example().parameter_digest, example().entry_names));
  try {
    require_same_case("c.h5", example(), "0000", {"one"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 2U);
  }
}

TEST_F(CheckpointTest, RefusesStatesWithoutNames) {
  Checkpoint checkpoint = example();
  checkpoint.entry_names.pop_back();
  EXPECT_THROW(write_checkpoint(directory, checkpoint), std::invalid_argument);
  EXPECT_THROW(write_checkpoint(directory, example(), 0), std::invalid_argument);
}

TEST_F(CheckpointTest, AFullDiskLeavesTheOlderCheckpointsAndNoRemains) {
  write_checkpoint(directory, example(1), 1);
  const pid_t writer = ::fork();
  if (writer == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};  // [bytes] a file may have; stands for a full disk
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto message = message_of([&] { write_checkpoint(directory, example(2), 1); });
    std::_Exit(message.find("File too large") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  ::waitpid(writer, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"checkpoint-000001.h5"}));
  EXPECT_EQ(newest_valid_checkpoint(directory).checkpoint->time, 1);
}

TEST_F(CheckpointTest, H5pyReadsACheckpoint) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) GTEST_SKIP() << "no h5py";
  const fs::path path = write_checkpoint(directory, example());
  const std::string script =
      "import h5py; f = h5py.File('" + path.string() +
      "', 'r'); assert f['time'][0] == 0.125; assert f['state'].shape == (4,); "
      "assert f['entry_names'].asstr()[2] == 'TB2/inner ring spin'; assert f['extras/window/TB2'][1] == 0.2";
  EXPECT_EQ(std::system(("/usr/bin/python3 -c \"" + script + "\"").c_str()), 0);
}

TEST_F(CheckpointTest, WriteTextAtomicallyReplacesTheWholeContent) {
  const fs::path path = directory / "summary.json";
  write_text_atomically(path, std::string(100000, 'a'));
  write_text_atomically(path, "short");
  EXPECT_EQ(content(path), "short");
  write_text_atomically(path, "");
  EXPECT_EQ(content(path), "");
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(CheckpointTest, WhoeverReadsDuringAWriteSeesTheOldOrTheNewContent) {
  const fs::path path = directory / "summary.json";
  const std::size_t size = 1000000;
  write_text_atomically(path, std::string(size, 'a'));
  const pid_t writer = ::fork();
  if (writer == 0)
    for (char letter = 'a';; letter = letter == 'a' ? 'b' : 'a') write_text_atomically(path, std::string(size, letter));
  for (int i = 0; i < 200; ++i) {
    const std::string text = content(path);
    EXPECT_EQ(text.size(), size);
    EXPECT_EQ(text.find_first_not_of(text[0]), std::string::npos) << "a mixture of two contents";
    if (HasFailure()) break;
  }
  ::kill(writer, SIGKILL);
  ::waitpid(writer, nullptr, 0);
}

TEST_F(CheckpointTest, WriteTextAtomicallySaysWhyItCannot) {
  const auto message = message_of([&] { write_text_atomically(directory / "missing" / "summary.json", "x"); });
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
  EXPECT_THROW(write_text_atomically(directory, "x"), InputError) << "a directory is in the way";
  EXPECT_TRUE(files().empty());
}

}  // namespace
