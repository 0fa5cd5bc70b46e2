#include "io/hdf5/recorded_series.h"

#include "io/hdf5/hdf5_driver.h"
#include "io/hdf5/series_reader.h"

namespace rotordrop {

namespace fs = std::filesystem;
using hdf5::attribute_texts;
using hdf5::Handle;
using hdf5::has_object;
using hdf5::SeriesReader;
using hdf5::throw_damaged;
using hdf5::throw_unreadable;

namespace {

SeriesMeaning meaning_of(hid_t owner, const fs::path& path, const std::string& dataset) {
  const auto texts = [&](const char* name) {
    return H5Aexists(owner, name) > 0 ? attribute_texts(owner, path, dataset, name) : std::vector<std::string>();
  };
  const auto text = [&](const char* name) {
    const auto found = texts(name);
    return found.empty() ? std::string() : found.front();
  };
  return {text("units"), text("long_name"), text("time"), texts("columns")};
}

}  // namespace

std::pair<Series, SeriesMeaning> read_series_with_meaning(const fs::path& path, const std::string& dataset) {
  const Handle file = hdf5::open_for_reading(path);
  const SeriesReader reader(file.id(), path, dataset);
  return {{reader.rows(0, reader.n_rows()), reader.shape()}, meaning_of(reader.id(), path, dataset)};
}

Series read_series(const fs::path& path, const std::string& dataset) {
  const Handle file = hdf5::open_for_reading(path);
  const SeriesReader reader(file.id(), path, dataset);
  return {reader.rows(0, reader.n_rows()), reader.shape()};
}

std::string read_text(const fs::path& path, const std::string& dataset) {
  const Handle file = hdf5::open_for_reading(path);
  if (!has_object(file.id(), dataset)) throw_unreadable(path, "there is no dataset " + dataset + " in this file.");
  const hid_t id = H5Dopen2(file.id(), dataset.c_str(), H5P_DEFAULT);
  if (id < 0) throw_unreadable(path, dataset + " cannot be read as a dataset (" + hdf5::last_error() + ").");
  const Handle opened(id, H5Dclose, dataset);
  const Handle type(H5Dget_type(id), H5Tclose, dataset);
  if (H5Tget_class(type.id()) != H5T_STRING) throw_unreadable(path, dataset + " does not hold text.");
  const auto texts = hdf5::read_texts(id, dataset);
  return texts.empty() ? std::string() : texts.front();
}

std::vector<std::string> read_attribute_list(const fs::path& path, const std::string& object, const std::string& name) {
  const Handle file = hdf5::open_for_reading(path);
  if (!has_object(file.id(), object)) throw_unreadable(path, "there is no " + object + " in this file.");
  const Handle owner(H5Oopen(file.id(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  return attribute_texts(owner.id(), path, object, name);
}

std::string read_attribute(const fs::path& path, const std::string& object, const std::string& name) {
  const auto texts = read_attribute_list(path, object, name);
  return texts.empty() ? std::string() : texts.front();
}

SeriesMeaning read_meaning(const fs::path& path, const std::string& dataset) {
  const Handle file = hdf5::open_for_reading(path);
  if (!has_object(file.id(), dataset)) throw_unreadable(path, "there is no " + dataset + " in this file.");
  const Handle owner(H5Oopen(file.id(), dataset.c_str(), H5P_DEFAULT), H5Oclose, dataset);
  return meaning_of(owner.id(), path, dataset);
}

std::vector<std::string> list_datasets(const fs::path& path) {
  const Handle file = hdf5::open_for_reading(path);
  try {
    return hdf5::dataset_paths(file.id());
  } catch (const SolverError& error) {
    throw_damaged(path, std::string("this file is damaged (") + error.what() + ").");
  }
}

}  // namespace rotordrop
