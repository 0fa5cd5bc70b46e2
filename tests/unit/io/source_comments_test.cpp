#include "io/text/source_comments.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace rotordrop {
namespace {

TEST(SourceComments, BeginAtTheFirstHashOutsideQuotes) {
  using Parts = std::pair<std::string_view, std::string_view>;
  EXPECT_EQ(split_comment("a = 1"), (Parts{"a = 1", ""}));
  EXPECT_EQ(split_comment("a = 1  #  est.  "), (Parts{"a = 1  ", "est."}));
  EXPECT_EQ(split_comment("a = \"x # y\" # z"), (Parts{"a = \"x # y\" ", "z"}));
  EXPECT_EQ(split_comment("a = 'x # \\' # z"), (Parts{"a = 'x # \\' ", "z"})) << "no escapes in single quotes";
  EXPECT_EQ(split_comment("a = \"x \\\" # y\" # z"), (Parts{"a = \"x \\\" # y\" ", "z"}));
  EXPECT_EQ(split_comment("a = 1 #"), (Parts{"a = 1 ", ""}));
}

TEST(SourceComments, SayFileLineAndWhatStandsThere) {
  const auto folder = std::filesystem::temp_directory_path() / ("rotordrop-sources-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string file = folder / "case.toml", data = folder / "rotor.json";
  std::ofstream(file) << "a = 1  # source: (P)\nb = 2\nc = 3  # from base.toml:7: source: (est.)\n";
  std::ofstream(data) << "{ \"#\": 1 }\n";
  SourceComments comments;
  EXPECT_EQ(comments.at({file, 1, 5}), "case.toml:1: source: (P)");
  EXPECT_EQ(comments.at({file, 2, 5}), "case.toml:2");
  EXPECT_EQ(comments.at({file, 3, 5}), "base.toml:7: source: (est.)") << "what rotordrop wrote names the first source";
  EXPECT_EQ(comments.at({file, 9, 1}), "case.toml:9") << "a line that is gone";
  EXPECT_EQ(comments.at({data, 1, 3}), "rotor.json:1") << "JSON has no comments";
  EXPECT_EQ(comments.at({"--set contact.air_gap", 0, 0}), "--set");
  EXPECT_EQ(comments.at({}), "the program");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rotordrop
