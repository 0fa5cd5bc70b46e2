#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "study/many/design.h"
#include "study/many/journal.h"
#include "study/many/study_run.h"

namespace rotordrop {

// Files of a study's directory: study.toml and case.toml (as they were used), study.journal, study.h5, study.csv, study.json; of a shard shard.h5
// instead of the last three.

/// Tells whether two studies have the same points of the same case: SHA-256 of all that decides about them.
std::string digest_of(const Study& study, const Design& design);

/// The header of a journal: digest, program, shard.
std::string journal_header(const Study& study, const std::string& digest, std::size_t shard, std::size_t n_shards);
/// @throws InputError if a journal is of another study, shard or version of the program
void require_same_study(const std::filesystem::path& journal, const std::string& found, const std::string& expected);

/// What the journal of a directory that is gone on with holds already; none if nothing is finished. Then the study's inputs are written.
std::optional<Journal::Content> earlier_points(const Study& study, const StudyOptions& options,
                                               const std::string& header);

/// rank-1.journal, ... of the other ranks of a study that several processes compute.
std::filesystem::path journal_of_rank(const std::filesystem::path& directory, int rank);
/// Their points become part of study.journal, and the files are removed. Those of a killed study, too.
/// @throws InputError if they are of another study
void take_journals_of_ranks(const std::filesystem::path& directory, const std::string& header);

/// Makes the page of a complete study again that lies in its directory: it shows an unfinished state, or other limits. @return whether there is one
bool renew_page(const std::filesystem::path& directory);
/// Removes point-17, ... that `study rerun` has made of a study that is replaced: only files of the program, and folders that this leaves empty.
void remove_rerun_points(const std::filesystem::path& directory);

/// Writes study.toml and case.toml, from which the study can be read again.
void write_inputs(const Study& study, const std::filesystem::path& directory);
/// The study of a directory. @throws InputError if there is none
Study read_study_of(const std::filesystem::path& directory);

/// The journals of shards become the results of one study in `output`.
/// @param is_virtual  results and series stay in the shards' files; study.h5 shows them as virtual datasets
/// @return number of points that no shard has finished
/// @throws InputError if they are of different studies, or unfinished ones that are to be shown virtually
std::size_t join_shards(const std::vector<std::filesystem::path>& directories, const std::filesystem::path& output,
                        bool force, bool is_virtual = false);

}  // namespace rotordrop
