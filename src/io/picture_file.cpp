#include "io/picture_file.h"

#include <cerrno>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "io/checkpoint.h"
#include "io/half_made_file.h"

namespace rotordrop {
namespace {

namespace fs = std::filesystem;

void draw(const fs::path& png, const std::string& svg) {
  const std::string whole = fs::absolute(png).string();  // a name may begin with -
  const fs::path drawing = whole + ".svg.writing", drawn = whole + ".writing";
  const HalfMadeFile drawing_goes(drawing), drawn_goes(drawn);
  write_text_atomically(drawing, svg);
  std::string words[] = {"rsvg-convert", "--format=png", "--zoom=2", "--output=" + drawn.string(), drawing.string()};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), words[4].data(), nullptr};
  pid_t child = -1;
  const int failed = ::posix_spawnp(&child, arguments[0], nullptr, nullptr, arguments, ::environ);
  if (failed == ENOENT)
    throw InputError({png.string(), 0, 0}, "a PNG is drawn by the command rsvg-convert, which is not installed.",
                     "Install the package librsvg2-bin, or ask for a file.svg.");
  int status = failed;
  while (failed == 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  std::error_code error;
  if (status == 0) fs::rename(drawn, png, error);
  if (status != 0 || error) throw SolverError("rsvg-convert could not draw " + png.string() + ".");
}

}  // namespace

void require_picture_name(const fs::path& file) {
  if (file.extension() != ".svg" && file.extension() != ".png")
    throw InputError({file.string(), 0, 0}, "a picture's name ends in .svg or .png.", "");
}

void write_picture(const fs::path& file, const std::string& svg) {
  require_picture_name(file);
  if (file.extension() == ".png")
    draw(file, svg);
  else
    write_text_atomically(file, svg);
}

}  // namespace rotordrop
