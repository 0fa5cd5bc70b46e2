// A case whose layers name different bearings of the catalogue. Here, so that sanitizers see it: the scripts of the command line run without them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/errors.h"
#include "case/case.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

class Layers : public testing::Test {
 protected:
  Layers() { fs::create_directories(folder); }
  ~Layers() override { fs::remove_all(folder); }
  Layers(const Layers&) = delete;
  Layers& operator=(const Layers&) = delete;

  void write(const std::string& name, const std::string& base, const std::string& text) const {
    std::ofstream(folder / name) << "base = \"" << base << "\"\n" << text;
  }
  [[nodiscard]] Case read(const std::string& name, const std::vector<std::string>& settings = {}) const {
    return read_case(folder / name, settings);
  }
  [[nodiscard]] static std::size_t n_warnings_with(const Case& c, const std::string& words) {
    std::size_t n = 0;
    for (const auto& warning : c.warnings) n += warning.message.find(words) != std::string::npos ? 1 : 0;
    return n;
  }

  fs::path folder = fs::temp_directory_path() / ("layers_" + std::to_string(::getpid()));
  std::string fits = "housing_diameters = [\"100 mm\", \"120 mm\"]\n";  // of the smaller bearings
  std::string reference = ROTORDROP_SOURCE_DIR "/params/neisi2019.toml";
};

TEST_F(Layers, AnotherNameBringsItsOwnBearingAndTellsWhatItReplaces) {
  write("middle.toml", reference, "[bearings.TB1]\ncatalogue = \"61914\"\nring_mass = \"0.25 kg\"\n" + fits);
  write("drop.toml", "middle.toml", "[bearings.TB1]\ncatalogue = \"71914-25\"\n");
  const std::string words = "replaces what the layers below say of \"61914\": ring_mass = 0.25 kg";
  EXPECT_EQ(n_warnings_with(read("drop.toml"), words), 1U);
  EXPECT_EQ(n_warnings_with(read("middle.toml", {"bearings.TB1.catalogue=\"71914-25\""}), words), 1U);
  EXPECT_EQ(n_warnings_with(read("middle.toml"), words), 0U);
}

TEST_F(Layers, TheSameNameLeavesWhatTheLayersBelowSay) {
  write("middle.toml", reference, "[bearings.TB1]\ncatalogue = \"61914\"\nring_mass = \"0.25 kg\"\n" + fits);
  write("drop.toml", "middle.toml", "[bearings.TB1]\ncatalogue = \"61914\"\n");
  const Case drop = read("drop.toml");
  const Node* mass = drop.tree.find("bearings")->find("TB1")->find("ring_mass");
  ASSERT_NE(mass, nullptr);
  EXPECT_EQ(mass->text(), "0.25 kg");
}

TEST_F(Layers, ANameThatTheCatalogueLacksIsToldAndHidesNothing) {
  write("drop.toml", reference, "[bearings.TB1]\ncatalogue = \"61915x\"\n[contact]\nfriction_coeficient = 0.1\n");
  try {
    (void)read("drop.toml");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("bearings.TB1.catalogue = \"61915x\": the catalogue has no such bearing."), std::string::npos)
        << said;
    EXPECT_NE(said.find("friction_coeficient"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace rotordrop
