#pragma once
#include <filesystem>
#include <system_error>
#include <utility>

namespace rotordrop {

/// Removes a half-made file unless told to keep it.
class HalfMadeFile {
 public:
  explicit HalfMadeFile(std::filesystem::path path) : path_(std::move(path)) {}
  HalfMadeFile(const HalfMadeFile&) = delete;
  HalfMadeFile& operator=(const HalfMadeFile&) = delete;
  ~HalfMadeFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  void keep() { path_.clear(); }

 private:
  std::filesystem::path path_;
};

}  // namespace rotordrop
