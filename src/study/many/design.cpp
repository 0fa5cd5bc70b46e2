#include "study/many/design.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parameters/value_reader.h"
#include "io/text/parameter_writers.h"
#include "study/many/random_bits.h"

namespace rotordrop {
namespace {

constexpr double most_points = 1e7;
// Columns of random numbers that must not meet.
constexpr std::uint64_t jitter_column = 1U << 20, order_column = 1U << 21, sign_column = 1U << 22;

void require_few(double n, const Study& study) {
  if (n * study.n_replicates > most_points)
    throw InputError(
        {study.file.string(), 0, 0},
        fmt::format("the design has {:.4g} drops; a study has at most {:.0e}.", n * study.n_replicates, most_points),
        "Choose fewer levels or a smaller size, or a latin-hypercube instead of a grid.");
}

std::vector<Node> levels_of(const Study& study, const VariedParameter& p) {
  if (!p.distribution.is_continuous()) return p.distribution.values;
  std::vector<Node> nodes;
  for (const double value :
       p.distribution.levels(p.levels.value_or(static_cast<std::size_t>(study.design.levels.value_or(5)))))
    nodes.emplace_back(value);
  return nodes;
}

void make_grid(const Study& study, const std::vector<std::size_t>& drawn, Design& design) {
  double n = 1.;
  for (const auto i : drawn) {
    design.nodes.push_back(levels_of(study, study.parameters[i]));
    n *= static_cast<double>(design.nodes.back().size());
  }
  require_few(n, study);
  design.n_rows = static_cast<std::size_t>(n);
  design.cells.resize(design.n_rows * drawn.size());
  for (std::size_t row = 0; row < design.n_rows; ++row) {
    std::size_t rest = row;
    for (std::size_t j = drawn.size(); j-- > 0;) {
      design.cells[row * drawn.size() + j] = static_cast<double>(rest % design.nodes[j].size());
      rest /= design.nodes[j].size();
    }
  }
}

void make_list(const Study& study, const std::vector<std::size_t>& drawn, Design& design) {
  for (const auto i : drawn) design.nodes.push_back(study.parameters[i].distribution.values);
  design.n_rows = design.nodes.front().size();
  require_few(static_cast<double>(design.n_rows), study);
  for (std::size_t row = 0; row < design.n_rows; ++row)
    design.cells.insert(design.cells.end(), drawn.size(), static_cast<double>(row));
}

/// The reference is the case itself: a parameter that sets several keys needs one value there.
void require_one_value(const Study& study, const VariedParameter& p, Faults& faults) {
  const auto first = own_value(study, p.keys.front());
  for (const auto& key : p.keys)
    if (const auto own = own_value(study, key); first && (!own || to_text(*own) != to_text(*first)))
      return faults.add(p.where,
                        fmt::format("vary.{}: in the case {} is {}, but {} {}.", p.name, p.keys.front().name,
                                    to_text(*first), key.name, own ? "is " + to_text(*own) : "has no value"),
                        "Add reference = VALUE: it is set into all of them.");
}

void make_one_at_a_time(const Study& study, const std::vector<std::size_t>& drawn, Design& design) {
  std::vector<double> reference;
  Faults faults;
  for (const auto i : drawn) {
    const auto& p = study.parameters[i];
    design.nodes.push_back(levels_of(study, p));
    const auto value = p.reference ? p.reference : own_value(study, p.keys.front());
    if (!p.reference) require_one_value(study, p, faults);
    if (!value) {
      faults.add(p.where, fmt::format("vary.{}: the case gives no value to refer to.", p.name),
                 "Add reference = VALUE.");
      continue;
    }
    reference.push_back(static_cast<double>(design.nodes.back().size()));
    design.nodes.back().push_back(*value);
  }
  faults.throw_if_any();
  for (const double index : reference) design.cells.push_back(index);
  for (std::size_t j = 0; j < drawn.size(); ++j)
    for (std::size_t k = 0; k + 1 < design.nodes[j].size(); ++k)
      for (std::size_t i = 0; i < drawn.size(); ++i)
        design.cells.push_back(i == j ? static_cast<double>(k) : reference[i]);
  design.n_rows = design.cells.size() / drawn.size();
  require_few(static_cast<double>(design.n_rows), study);
}

/// Lower Cholesky factor of the normal scores' correlation that gives the asked rank correlations: r = 2 sin(pi rho / 6).
Eigen::MatrixXd copula_factor(const Study& study, std::size_t d) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(d));
  for (const auto& c : study.correlations) {
    const double r = 2. * std::sin(std::numbers::pi * c.value / 6.);
    R(static_cast<Eigen::Index>(c.first), static_cast<Eigen::Index>(c.second)) = r;
    R(static_cast<Eigen::Index>(c.second), static_cast<Eigen::Index>(c.first)) = r;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(R);
  if (factor.info() != Eigen::Success)
    throw InputError({study.file.string(), 0, 0}, "the [[correlation]] entries contradict each other.",
                     "Their matrix must be positive definite, and no rank may be 1 or -1.");
  return factor.matrixL();
}

/// Normal scores of one row, correlated.
class Scores {
 public:
  Scores(const Study& study, std::size_t d) : is_plain_(study.correlations.empty()) {
    if (!is_plain_) L_ = copula_factor(study, d);
  }
  [[nodiscard]] bool is_plain() const { return is_plain_; }
  /// Probabilities [d] become normal scores.
  void apply(std::vector<double>& u) const {
    const boost::math::normal normal;
    for (double& x : u) x = boost::math::quantile(normal, x);
    Eigen::Map<Eigen::VectorXd> z(u.data(), static_cast<Eigen::Index>(u.size()));
    z = (L_ * z).eval();
  }

 private:
  bool is_plain_;
  Eigen::MatrixXd L_;
};

/// The Sobol sequence with Joe & Kuo's direction numbers (new-joe-kuo-6), as boost::random::sobol has them.
class SobolRows {
 public:
  SobolRows(std::size_t dimensions, const DesignParameters& design)
      : engine_(dimensions), seed_(static_cast<std::uint64_t>(design.seed)), shifts_(design.scramble) {}
  /// The next row: without a shift from the sequence's second point, for its first one is 0 and lies on the edge.
  void next(std::vector<double>& row) {
    const bool is_origin = shifts_ && !began_;
    began_ = true;
    for (std::size_t j = 0; j < row.size(); ++j) {
      const std::uint64_t bits = is_origin ? 0 : engine_();
      row[j] = shifts_ ? unit_interval(bits ^ mixed(mixed(seed_) ^ j)) : static_cast<double>(bits) * 0x1p-64;
    }
  }

 private:
  boost::random::sobol engine_;
  std::uint64_t seed_;
  bool shifts_, began_ = false;
};

void make_sample(const Study& study, std::size_t d, Design& design) {
  const auto n = static_cast<std::size_t>(*study.design.size);
  require_few(static_cast<double>(n), study);
  const auto seed = static_cast<std::uint64_t>(study.design.seed);
  const Scores scores(study, d);
  const boost::math::normal normal;
  design.n_rows = n;
  design.unit.resize(n * d);
  if (design.kind == DesignKind::latin_hypercube) {
    // Strata in the order of random scores: margins stay stratified whatever the correlation (Iman & Conover 1982).
    std::vector<double> z(n * d);
    std::vector<double> u(d);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t j = 0; j < d; ++j) u[j] = uniform_number(seed, k, j);
      if (!scores.is_plain()) scores.apply(u);
      for (std::size_t j = 0; j < d; ++j) z[k * d + j] = u[j];
    }
    std::vector<std::size_t> order(n);
    for (std::size_t j = 0; j < d; ++j) {
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return z[a * d + j] < z[b * d + j]; });
      for (std::size_t rank = 0; rank < n; ++rank)
        design.unit[order[rank] * d + j] =
            (static_cast<double>(rank) + uniform_number(seed, order[rank], jitter_column + j)) / static_cast<double>(n);
    }
    return;
  }
  SobolRows sobol(d, study.design);
  std::vector<double> u(d);
  for (std::size_t k = 0; k < n; ++k) {
    if (design.kind == DesignKind::sobol_sequence)
      sobol.next(u);
    else
      for (std::size_t j = 0; j < d; ++j) u[j] = uniform_number(seed, k, j);
    if (!scores.is_plain()) {
      scores.apply(u);
      for (double& x : u) x = boost::math::cdf(normal, x);
    }
    for (std::size_t j = 0; j < d; ++j) design.unit[k * d + j] = u[j];
  }
}

void make_saltelli(const Study& study, std::size_t d, Design& design) {
  const auto n = static_cast<std::size_t>(*study.design.size);
  require_few(static_cast<double>(n) * static_cast<double>(d + 2), study);
  design.n_blocks = n;
  design.n_rows = n * (d + 2);
  SobolRows sobol(2 * d, study.design);
  std::vector<double> row(2 * d);
  for (std::size_t k = 0; k < n; ++k) {
    sobol.next(row);
    design.unit.insert(design.unit.end(), row.begin(), row.end());  // A, then B
    for (std::size_t j = 0; j < d; ++j)
      for (std::size_t i = 0; i < d; ++i) design.unit.push_back(row[i == j ? d + j : i]);
  }
}

/// Morris 1991: trajectories on a grid of p levels, each step p/2 levels. The levels of a list are its values, whatever their weights.
void make_morris(const Study& study, const std::vector<std::size_t>& drawn, Design& design) {
  const std::size_t d = drawn.size();
  const auto r = static_cast<std::size_t>(*study.design.size);
  require_few(static_cast<double>(r) * static_cast<double>(d + 1), study);
  std::vector<int> p, step;
  for (const auto i : drawn) {
    const auto& distribution = study.parameters[i].distribution;
    p.push_back(distribution.is_continuous() ? study.design.levels.value_or(4)
                                             : static_cast<int>(distribution.values.size()));
    step.push_back(p.back() / 2);
  }
  const auto seed = static_cast<std::uint64_t>(study.design.seed);
  design.n_blocks = r;
  design.n_rows = r * (d + 1);
  design.morris_levels = p;
  for (std::size_t t = 0; t < r; ++t) {
    std::vector<int> level(d), sign(d);
    std::vector<std::size_t> order(d);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t j = 0; j < d; ++j) {
      level[j] = static_cast<int>(uniform_number(seed, t, j) * (p[j] - step[j]));
      sign[j] = uniform_number(seed, t, sign_column + j) < 0.5 ? 1 : -1;
      if (sign[j] < 0) level[j] += step[j];
    }
    for (std::size_t j = d; j-- > 1;)
      std::swap(
          order[j],
          order[static_cast<std::size_t>(uniform_number(seed, t, order_column + j) * static_cast<double>(j + 1))]);
    const auto add = [&] {
      for (std::size_t j = 0; j < d; ++j)
        design.unit.push_back(p[j] > 1 ? static_cast<double>(level[j]) / (p[j] - 1) : 0.);
    };
    add();
    for (const auto j : order) {
      level[j] += sign[j] * step[j];
      add();
    }
  }
}

/// From the unit cube to values.
void fill_cells(const Study& study, const std::vector<std::size_t>& drawn, Design& design) {
  const std::size_t d = drawn.size();
  design.nodes.assign(d, {});
  design.cells.resize(design.unit.size());
  for (std::size_t j = 0; j < d; ++j) {
    const auto& distribution = study.parameters[drawn[j]].distribution;
    if (!distribution.is_continuous()) design.nodes[j] = distribution.values;
    std::vector<double> levels;
    if (design.kind == DesignKind::morris && distribution.is_continuous())
      levels = distribution.levels(static_cast<std::size_t>(design.morris_levels[j]));
    for (std::size_t row = 0; row < design.n_rows; ++row) {
      const double u = design.unit[row * d + j];
      double& cell = design.cells[row * d + j];
      if (design.kind == DesignKind::morris) {
        const auto k = static_cast<std::size_t>(std::lround(u * (design.morris_levels[j] - 1)));
        cell = levels.empty() ? static_cast<double>(k) : levels[k];
      } else {
        cell = distribution.is_continuous() ? distribution.quantile(u) : static_cast<double>(distribution.index(u));
      }
    }
  }
}

}  // namespace

std::optional<Node> own_value(const Study& study, const DeclaredKey& key) {
  const auto given = value_of_key(key, study.base.tree);
  if (!given || !key.is_quantity()) return given;
  Faults faults;
  const auto value = read_quantity(*given, {.unit = key.unit, .kind = key.quantity}, key.name, faults);
  return value ? std::optional(Node(*value)) : std::nullopt;
}

Node Design::value(std::size_t row, std::size_t drawn) const {
  const double cell = cells[row * n_drawn + drawn];
  return nodes[drawn].empty() ? Node(cell) : nodes[drawn][static_cast<std::size_t>(cell)];
}

Design make_design(const Study& study) {
  const auto drawn = study.drawn();
  Design design;
  design.kind = study.design.kind;
  design.n_drawn = drawn.size();
  switch (design.kind) {
    case DesignKind::grid:
      make_grid(study, drawn, design);
      return design;
    case DesignKind::list:
      make_list(study, drawn, design);
      return design;
    case DesignKind::one_at_a_time:
      make_one_at_a_time(study, drawn, design);
      return design;
    case DesignKind::saltelli:
      make_saltelli(study, drawn.size(), design);
      break;
    case DesignKind::morris:
      make_morris(study, drawn, design);
      break;
    default:
      make_sample(study, drawn.size(), design);
  }
  fill_cells(study, drawn, design);
  return design;
}

std::size_t n_points(const Study& study, const Design& design) {
  return design.n_rows * static_cast<std::size_t>(study.n_replicates);
}

namespace {

/// A number as a key takes it.
Node value_for(const DeclaredKey& key, double number) {
  const bool is_whole = number == std::trunc(number) && std::fabs(number) < 1e15;
  return key.declaration.kind == Declaration::Kind::integer && is_whole ? Node(static_cast<std::int64_t>(number))
                                                                        : Node(number);
}

}  // namespace

StudyPoint point_of(const Study& study, const Design& design, std::size_t index) {
  StudyPoint point;
  const auto n = static_cast<std::size_t>(study.n_replicates);
  point.row = index / n;
  point.replicate = static_cast<int>(index % n);
  point.values.resize(study.parameters.size());
  const auto drawn = study.drawn();
  for (std::size_t j = 0; j < drawn.size(); ++j) point.values[drawn[j]] = design.value(point.row, j);
  double height = 0.;
  bool has_height = false;
  const std::string height_key = "rotor.initial_offset[0]";
  for (std::size_t i = 0; i < study.parameters.size(); ++i) {
    const auto& p = study.parameters[i];
    if (p.formula) {
      std::vector<double> values;
      for (const auto of : p.formula_of) values.push_back(point.values[of].number());
      point.values[i] = value_for(p.keys.front(), p.formula->value(values));
    }
    for (const auto& key : p.keys) {
      if (key.name == height_key) {
        height = point.values[i].number();
        has_height = true;
        if (point.replicate > 0) continue;  // set below
      }
      point.overrides.push_back(key.name + "=" + toml_value(point.values[i]));
    }
  }
  if (point.replicate > 0) {
    if (!has_height) {
      const DeclaredKey key = declared_key(height_key, study.base.tree, {study.file.string(), 0, 0});
      if (const auto own = own_value(study, key)) height = own->number();
    }
    point.overrides.push_back(height_key + "=" + toml_value(Node(height + point.replicate * study.replicate_spread)));
  }
  return point;
}

}  // namespace rotordrop
