#include "base/version.h"
#include "io/checkpoint.h"
#include "io/hdf5/recorder.h"
#include "study/compare/comparison.h"

namespace rotordrop {
namespace {

std::vector<Channel> bore_channels(const std::string& path) {
  return {{path + "inner_ring", "K", "inner ring of the lumped circuit", 1, {}},
          {path + "mean", "K", "bore, mean around the circumference", 1, {}},
          {path + "local", "K", "hottest point around the bore (moving band)", 1, {}},
          {path + "flash", "K", "bore under the middle of the contact (moving band); NaN without contact", 1, {}},
          {path + "rotor_flash",
           "K",
           "temperature rise of the rotor surface under the contact (Jaeger); NaN without contact",
           1,
           {}},
          {path + "arc", "rad", "angle swept by the contact over the bore since contact began", 1, {}},
          {path + "heated_arc", "rad", "total arc of the bore rubbed so far", 1, {}},
          {path + "ring_turns", "1", "turns of the inner ring", 1, {}}};
}

}  // namespace

std::filesystem::path comparison_series_file(const std::filesystem::path& file) {
  return std::filesystem::path(file).replace_extension(".h5");
}

void write_comparison(const Comparison& comparison, const std::filesystem::path& file) {
  std::vector<SeriesGroup> groups;
  for (const auto& b : comparison.bores)
    groups.push_back({"/bore/" + b.bearing + "/time", bore_channels("/bore/" + b.bearing + "/")});
  RecorderOptions options;
  options.overwrite = true;
  Recorder recorder(comparison_series_file(file),
                    {{{"program", program_name()}, {"content", "temperatures of the bores"}}, {}}, groups, options);
  for (std::size_t k = 0; k < comparison.bores.size(); ++k) {
    const auto& b = comparison.bores[k];
    for (std::size_t i = 0; i < b.history.times.size(); ++i) {
      const double row[] = {b.node[i],
                            b.mean[i],
                            b.local[i],
                            b.flash[i],
                            b.rotor_flash[i],
                            b.history.arc[i],
                            b.history.heated_arc[i],
                            b.history.ring_turns[i]};
      recorder.append(k, b.history.times[i], row);
    }
  }
  recorder.close();
  write_text_atomically(file, comparison.report.dump(2) + "\n");
}

}  // namespace rotordrop
