#include "study/drop/drop_record.h"

#include "base/processor.h"
#include "base/version.h"
#include "base/wide_vectors.h"
#include "case/given_values.h"
#include "case/named_files.h"
#include "integrate/sundials_version.h"
#include "io/hdf5/hdf5_version.h"
#include "io/hdf5/recorded_series.h"
#include "io/hdf5/resumed_recording.h"

namespace rotordrop {
namespace {

/// Those that a resumed run had so far, and the one that it has now.
std::string instruction_sets(const std::filesystem::path& recorded) {
  const std::string now = name_of(vector_level);
  std::string before = "unknown";
  try {
    before = read_attribute(recorded, "/", "instruction_set");
  } catch (const DamagedFile&) {
    throw;
  } catch (const InputError&) {  // of an earlier version
  }
  return before == now || before.ends_with(", " + now) ? before : before + ", " + now;
}

RecordHeader record_header(const Case& drop_case, const std::string& instruction_set) {
  RecordHeader header{
      {{"program", program_name()},
       {"git_revision", git_revision()},
       {"sundials_version", sundials_version()},
       {"hdf5_version", hdf5_version()},
       {"processor", processor_name()},
       {"instruction_set", instruction_set},
       {"case", drop_case.name},
       {"frame",
        "x along the rotor axis, y up, z horizontal; y, z from the unloaded outer ring's axis; angles from +y "
        "towards +z"}},
      {{"/parameters", drop_case.resolved.text}, {"/given", given_values_json(drop_case.resolved)}}};
  std::string inputs;
  for (const auto& file : named_files(drop_case)) inputs += file.digest + " " + file.path.string() + "\n";
  if (!inputs.empty()) header.texts.emplace_back("/inputs", inputs);
  return header;
}

}  // namespace

DropRecord::DropRecord(const std::filesystem::path& directory, const Case& drop_case, const Machine& machine,
                       Drop& drop)
    : file_(directory / "results.h5"), case_(drop_case) {
  drop.rows().add(add_group("/time", {&machine.step_observables(), &machine.state_observables()}));
  if (!machine.detail_observables().empty())
    drop.detail_rows().add(add_group("/detail/time", {&machine.detail_observables()}));
  if (const auto own = drop.sections().observables(); !own.empty())
    drop.sections().add(add_group("/windows/time", {&own}));
}

RowSink& DropRecord::add_group(const std::string& times, std::initializer_list<const std::vector<Observable>*> lists) {
  SeriesGroup group{times, {}};
  for (const auto* list : lists)
    for (const auto& o : *list) group.channels.push_back({o.name, o.unit, o.long_name, o.size, o.columns});
  groups_.push_back(std::move(group));
  return sinks_.emplace_back(*this, groups_.size() - 1);
}

void DropRecord::open(bool overwrite, bool in_lanes) {
  RecorderOptions options;
  options.overwrite = overwrite;
  options.seconds_until_made = 0.15;  // a drop that is over sooner is written in one go, which takes half the time
  RecordHeader header = record_header(case_, name_of(vector_level));
  if (in_lanes) header.attributes.emplace_back("lanes", "yes");
  recorder_.emplace(file_, header, groups_, options);
}

void DropRecord::resume(double time, const RecordedRows& recorded, MemorySeries& series) {
  const RecordHeader header = record_header(case_, instruction_sets(file_));
  recorder_.emplace(resume_recording(file_, time, header, groups_, {}, recorded).recorder);
  recorder_->flush();
  series.restore([&](const std::string& path) { return read_series(file_, path).values; });
}

}  // namespace rotordrop
