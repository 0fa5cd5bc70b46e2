#include "cache/plain_data.h"

#include "io/sha256.h"

namespace rotordrop::plain {
namespace {

template <class T>
std::optional<std::string> digest_if_plain(const T& x) {
  Writer writer;
  writer.add(x);
  if (!writer.is_plain()) return std::nullopt;
  return sha256_of(writer.bytes());
}

}  // namespace

std::optional<std::string> digest_of(const HeatConductionProblem& problem) {
  HeatConductionProblem in_space = problem;
  for (auto& flux : in_space.fluxes) flux.times = flux.values = {};
  in_space.numerics.tolerance = in_space.numerics.fixed_step = 0.;
  return digest_if_plain(in_space);
}
std::optional<std::string> digest_of(const ElasticProblem& problem) { return digest_if_plain(problem); }
std::string digest_of(const SectionPlan& plan) { return sha256_of(bytes_of(plan)); }
std::string digest_of(const ReductionSettings& settings) { return sha256_of(bytes_of(settings)); }
std::string digest_of(std::span<const double> values) {
  return sha256_of({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

}  // namespace rotordrop::plain
