#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/many/answers/summary_watch.h"
#include "study/many/study_table.h"

namespace rotordrop {

/// study.json: what the points say together. docs/how-to/studies.md explains every key. @throws SummaryStopped
nlohmann::ordered_json study_summary(const Study& study, const Design& design, const StudyTable& table,
                                     const SummaryWatch& watch = {});

/// A few lines on the screen.
std::string study_text(const Study& study, const nlohmann::ordered_json& summary);

/// How many drops ended before the rotor touched anything, for the screen and the page; empty if none did.
std::string without_contact_text(const nlohmann::ordered_json& summary);

/// How many drops failed, which no statistic counts, for the screen and the page; empty if none did, and for searches.
std::string failed_text(const nlohmann::ordered_json& summary);

/// study.h5, study.csv and study.json. @param shards  as of write_study_hdf5() @throws SummaryStopped, nothing being written then
void write_results(const std::filesystem::path& directory, const Study& study, const Design& design,
                   const StudyTable& table, const std::string& digest, const SummaryWatch& watch = {},
                   const std::vector<ShardFile>& shards = {});

/// Values of a result by rows of the design: means over the replicates that are done, NaN where none is.
std::vector<double> row_means(const Study& study, const Design& design, const ResultColumn& column);

/// Points that are a sample of the parameters' distribution; empty if the design has none (a grid).
std::vector<std::size_t> sample_points(const Study& study, const Design& design);

}  // namespace rotordrop
