#pragma once
// What the tests of studies share: a folder with study files beside the reference case.
#include <filesystem>
#include <fstream>
#include <string>

#include "study/many/study_run.h"

namespace rotordrop::test {

class StudyFolder {
 public:
  StudyFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "rotordrop-studies-XXXXXX").string();
    if (::mkdtemp(name.data())) path_ = name;
  }
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;
  ~StudyFolder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// A study of the reference case.
  std::filesystem::path write(const std::string& text, const std::string& name = "study.toml") const {
    std::ofstream(path_ / name) << "case = \"neisi2019-settling.toml\"\n" << text;
    return path_ / name;
  }
  [[nodiscard]] Study read(const std::string& text) const { return read_study(write(text)); }

 private:
  std::filesystem::path path_;
};

}  // namespace rotordrop::test
