#include "apps/optimisation/genetic_search.h"

#include "base/errors.h"

#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/compass_search.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

namespace optimisation
{
  namespace
  {
    constexpr double   crossover = 0.8, crossover_index = 2;
    constexpr double   mutation_width = 0.1; // of the cube, at the start
    constexpr int      stages         = 10;  // of falling widths: sga keeps the one that it was made with
    constexpr unsigned tournament     = 2;

    // What follows is a compass search, not pagmo's CMA-ES: that keeps matrices of Eigen, whose alignment in Breccia is not that of
    // the library (cmake/BrecciaOptions.cmake), and would free what the other has allocated.
    constexpr unsigned last_evaluations = 20000;
    constexpr double   first_reach = 1e-2, last_reach = 1e-12, reduction = 0.5; // of the cube

    /** The function as pagmo calls it. */
    struct FunctionInCube
    {
      std::function<double(const Eigen::VectorXd &)> function;
      int                                            variables = 1; // pagmo makes empty problems

      pagmo::vector_double fitness(const pagmo::vector_double &place) const
      {
        return {function(Eigen::Map<const Eigen::VectorXd>(place.data(), place.size()))};
      }
      std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const
      {
        return {pagmo::vector_double(variables, 0.0), pagmo::vector_double(variables, 1.0)};
      }
    };

    /** Widths of mutation fall as (1 - g / G)^2 by stages. */
    pagmo::population evolved(pagmo::population population, const int variables, const GeneticOptions &options)
    {
      for (int stage = 0; stage < stages; ++stage)
        {
          const int    generations = options.generations * (stage + 1) / stages - options.generations * stage / stages;
          const double left        = 1 - double(stage) / stages;
          if (generations == 0)
            continue;
          const pagmo::algorithm search{pagmo::sga(generations, crossover, crossover_index, 1.0 / variables,
                                                   mutation_width * left * left, tournament, "sbx", "gaussian",
                                                   "tournament", static_cast<unsigned>(options.seed + stage))};
          population = search.evolve(population);
        }
      return population;
    }

    /** From the best of the population. */
    pagmo::vector_double sharpened(const pagmo::problem &problem, const pagmo::population &found, const unsigned seed)
    {
      pagmo::population best(problem, 0, seed);
      best.push_back(found.champion_x());
      const pagmo::algorithm search{pagmo::compass_search(last_evaluations, first_reach, last_reach, reduction)};
      return search.evolve(best).champion_x();
    }
  } // namespace

  Eigen::VectorXd genetic_minimum(const std::function<double(const Eigen::VectorXd &)> &function,
                                  const int                                             variables,
                                  const GeneticOptions                                 &options)
  {
    if (variables < 1 || options.population < 4 || options.population % 2 != 0)
      throw base::InputError("a genetic search needs a variable, and an even population of at least 4.");
    const pagmo::problem    problem{FunctionInCube{function, variables}};
    const pagmo::population found =
      evolved(pagmo::population(problem, static_cast<pagmo::population::size_type>(options.population),
                                static_cast<unsigned>(options.seed)),
              variables, options);
    const pagmo::vector_double best = sharpened(problem, found, static_cast<unsigned>(options.seed));
    return Eigen::Map<const Eigen::VectorXd>(best.data(), static_cast<Eigen::Index>(best.size()));
  }
} // namespace optimisation
