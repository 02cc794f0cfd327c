#include "apps/studies/inversion.h"

#include "apps/statistics/space_filling.h"
#include "base/errors.h"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    constexpr double as_good       = 1e-6; // of misfits
    constexpr int    places_in_box = 200;
    constexpr int    most_steps = 100, most_halvings = 30, most_weightings = 60;
    constexpr double smallest_step = 1e-14; // in the unit cube
    constexpr double smallest_part = 1e-9;  // of a deviation, as a weight

    using Bounds = std::map<std::string, std::pair<double, double>>;

    /** Of each factor where all surfaces that have it were fitted, unless the question says otherwise. */
    Bounds bounds_of(const InversionQuestion &question)
    {
      Bounds bounds;
      for (const StoredSurface &surface : question.surfaces)
        for (std::size_t k = 0; k < surface.polynomial.factors().size(); ++k)
          {
            const std::pair<double, double> own(surface.box.lower[k], surface.box.upper[k]);
            const auto [known, is_new] = bounds.emplace(surface.polynomial.factors()[k], own);
            if (!is_new)
              known->second = {std::max(known->second.first, own.first), std::min(known->second.second, own.second)};
          }
      for (const auto &[factor, own] : question.box)
        {
          if (bounds.find(factor) == bounds.end())
            throw base::InputError("--box " + factor + ": no surface has this factor.");
          if (!(own.first < own.second))
            throw base::InputError(fmt::format("--box {}={:g},{:g}: the lowest value must be below the highest.",
                                               factor, own.first, own.second));
          bounds[factor] = own;
        }
      for (const auto &[factor, own] : bounds)
        if (!(own.first < own.second))
          throw base::InputError("the boxes of the surfaces leave no room for " + factor + ". Give one by --box.");
      return bounds;
    }

    /** The question in the unit cube of all constants. */
    class CubeProblem
    {
    public:
      explicit CubeProblem(const InversionQuestion &question_)
        : question(question_)
      {
        const Bounds bounds = bounds_of(question);
        box                 = {Eigen::VectorXd(bounds.size()), Eigen::VectorXd(bounds.size())};
        for (const auto &[factor, own] : bounds)
          {
            box.lower[factors.size()] = own.first;
            box.upper[factors.size()] = own.second;
            factors.push_back(factor);
          }
        for (const StoredSurface &surface : question.surfaces)
          {
            places.emplace_back();
            for (const std::string &factor : surface.polynomial.factors())
              places.back().push_back(
                static_cast<int>(std::find(factors.begin(), factors.end(), factor) - factors.begin()));
          }
      }

      int             variables() const { return static_cast<int>(factors.size()); }
      Eigen::VectorXd constants(const Eigen::VectorXd &cube) const
      {
        return box.lower + cube.cwiseProduct(box.upper - box.lower);
      }
      /** Those of one surface. */
      Eigen::VectorXd point(const Eigen::VectorXd &constants, const std::size_t surface) const
      {
        return constants(places[surface]);
      }

      Eigen::VectorXd responses(const Eigen::VectorXd &cube) const
      {
        const Eigen::VectorXd all = constants(cube);
        Eigen::VectorXd       values(places.size());
        for (std::size_t k = 0; k < places.size(); ++k)
          values[k] = question.surfaces[k].value(point(all, k));
        return values;
      }

      /** Relative. */
      Eigen::VectorXd deviations(const Eigen::VectorXd &cube) const
      {
        Eigen::VectorXd values = responses(cube);
        for (Eigen::Index k = 0; k < values.size(); ++k)
          values[k] = (values[k] - question.targets[k]) / (question.over_prediction ? values[k] : question.targets[k]);
        return values;
      }

      Eigen::MatrixXd jacobian(const Eigen::VectorXd &cube) const
      {
        const Eigen::VectorXd all    = constants(cube);
        Eigen::MatrixXd       matrix = Eigen::MatrixXd::Zero(places.size(), cube.size());
        for (std::size_t k = 0; k < places.size(); ++k)
          {
            const double          value = question.surfaces[k].value(point(all, k)), target = question.targets[k];
            const double          scale    = question.over_prediction ? target / (value * value) : 1 / target;
            const Eigen::VectorXd gradient = question.surfaces[k].gradient(point(all, k));
            for (std::size_t factor = 0; factor < places[k].size(); ++factor)
              matrix(k, places[k][factor]) = gradient[factor] * scale;
          }
        return matrix * (box.upper - box.lower).asDiagonal();
      }

      double misfit(const Eigen::VectorXd &cube) const { return deviations(cube).cwiseAbs().sum(); }

      std::vector<std::string> factors;
      statistics::Box          box;

    private:
      const InversionQuestion      &question;
      std::vector<std::vector<int>> places; ///< of the factors of each surface among all
    };

    /** Variables that are not held by a bound that the sum of squares pushes them against. */
    std::vector<int> free_variables(const Eigen::VectorXd &cube, const Eigen::VectorXd &slope)
    {
      std::vector<int> kept;
      for (int k = 0; k < cube.size(); ++k)
        if (!(cube[k] <= 0 && slope[k] > 0) && !(cube[k] >= 1 && slope[k] < 0))
          kept.push_back(k);
      return kept;
    }

    /**
     * One step of Gauss and Newton's method within bounds; of the many steps where there are fewer targets than constants, the
     * shortest. @return false where none lessens the sum of weighted squares
     */
    bool step_down(const CubeProblem &problem, const Eigen::VectorXd &weights, Eigen::VectorXd &cube)
    {
      const Eigen::VectorXd  deviations = weights.cwiseProduct(problem.deviations(cube));
      const Eigen::MatrixXd  jacobian   = weights.asDiagonal() * problem.jacobian(cube);
      const std::vector<int> kept       = free_variables(cube, jacobian.transpose() * deviations);
      if (kept.empty())
        return false;
      const Eigen::MatrixXd own  = jacobian(Eigen::all, kept);
      Eigen::VectorXd       move = Eigen::VectorXd::Zero(cube.size());
      move(kept)                 = -own.completeOrthogonalDecomposition().solve(deviations);
      for (int halving = 0; halving < most_halvings; ++halving, move /= 2)
        {
          const Eigen::VectorXd next = (cube + move).cwiseMax(0).cwiseMin(1);
          if (weights.cwiseProduct(problem.deviations(next)).squaredNorm() < deviations.squaredNorm())
            {
              const double length = (next - cube).norm();
              cube                = next;
              return length > smallest_step;
            }
        }
      return false;
    }

    Eigen::VectorXd polished(const CubeProblem &problem, Eigen::VectorXd cube, const Eigen::VectorXd &weights)
    {
      for (int step = 0; step < most_steps && step_down(problem, weights, cube); ++step)
        ;
      return cube;
    }

    /** Least squares; where the targets cannot be met, weighted again and again until squares stand for magnitudes. */
    Eigen::VectorXd least_misfit(const CubeProblem &problem, const Eigen::VectorXd &place)
    {
      Eigen::VectorXd weights = Eigen::VectorXd::Ones(problem.deviations(place).size());
      Eigen::VectorXd best = place, cube = polished(problem, place, weights);
      for (int weighting = 0;; ++weighting)
        {
          const double gain = problem.misfit(best) - problem.misfit(cube);
          if (gain > 0)
            best = cube;
          if (weighting == most_weightings || problem.misfit(best) < as_good || (weighting > 3 && gain < as_good / 100))
            return best;
          weights = problem.deviations(cube).cwiseAbs().cwiseMax(smallest_part).cwiseSqrt().cwiseInverse();
          cube    = polished(problem, cube, weights);
        }
    }

    std::vector<Eigen::VectorXd> searched(const InversionQuestion &question, const CubeProblem &problem)
    {
      std::vector<Eigen::VectorXd> found;
      const auto                   misfit = [&problem](const Eigen::VectorXd &cube) { return problem.misfit(cube); };
      for (int start = 0; start < question.starts; ++start)
        {
          optimisation::GeneticOptions options = question.genetic;
          options.seed += 1000 * start; // each uses a few seeds that follow
          found.push_back(least_misfit(problem, optimisation::genetic_minimum(misfit, problem.variables(), options)));
        }
      const Eigen::MatrixXd all_over =
        statistics::latin_hypercube(places_in_box, problem.variables(), question.genetic.seed);
      for (Eigen::Index place = 0; place < all_over.rows(); ++place)
        found.push_back(least_misfit(problem, all_over.row(place).transpose()));
      return found;
    }

    std::vector<std::string>
    warnings_of(const InversionQuestion &question, const CubeProblem &problem, const Inversion &found)
    {
      std::vector<std::string> warnings;
      for (std::size_t k = 0; k < question.targets.size(); ++k)
        {
          const std::string &name = question.surfaces[k].response;
          const double       off  = found.best().responses[k] / question.targets[k] - 1;
          if (!found.reached && std::fabs(off) > as_good)
            warnings.push_back(
              fmt::format("{} = {:.6g} cannot be met within the box: the surface comes to {:.6g}, off by {:.3g} %.",
                          name, question.targets[k], found.best().responses[k], 100 * off));
          if (!question.surfaces[k].box.contains(problem.point(found.best().constants, k)))
            warnings.push_back("The answer lies outside the runs that the surface of " + name + " was fitted to.");
        }
      return warnings;
    }
  } // namespace

  Inversion invert(const InversionQuestion &question)
  {
    for (std::size_t k = 0; k < question.targets.size(); ++k)
      if (question.targets[k] == 0)
        throw base::InputError("--target " + question.surfaces[k].response +
                               "=0: deviations are relative to the target, which must not be zero.");
    const CubeProblem            problem(question);
    std::vector<Eigen::VectorXd> found = searched(question, problem);
    double                       least = INFINITY;
    for (const Eigen::VectorXd &cube : found)
      least = std::min(least, problem.misfit(cube));
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const Eigen::VectorXd &cube) { return !(problem.misfit(cube) <= least + as_good); }),
                found.end());
    const auto from_centre = [](const Eigen::VectorXd &cube) { return (cube.array() - 0.5).square().sum(); };
    std::stable_sort(found.begin(), found.end(), [&](const Eigen::VectorXd &a, const Eigen::VectorXd &b) {
      return from_centre(a) < from_centre(b);
    });
    Inversion inversion;
    inversion.factors = problem.factors;
    inversion.box     = problem.box;
    inversion.reached = least <= as_good;
    for (const Eigen::VectorXd &cube : found)
      inversion.equally_good.push_back({problem.constants(cube), problem.responses(cube), problem.misfit(cube)});
    inversion.warnings = warnings_of(question, problem, inversion);
    return inversion;
  }
} // namespace apps
