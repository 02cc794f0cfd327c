#include "apps/studies/sought_constants.h"

#include "apps/optimisation/direct_search.h"

#include <algorithm>

namespace apps
{
  SoughtConstants::SoughtConstants(const CalibrationFile &file_, CalibrationRuns &runs_)
    : file(file_)
    , runs(runs_)
    , all(file.constants.size())
  {
    for (std::size_t k = 0; k < file.constants.size(); ++k)
      {
        all[k] = file.constants[k].start;
        sought.push_back(static_cast<int>(k));
      }
  }

  Eigen::VectorXd SoughtConstants::ranges() const
  {
    Eigen::VectorXd values(all.size());
    for (Eigen::Index k = 0; k < all.size(); ++k)
      values[k] = file.constants[k].upper - file.constants[k].lower;
    return values;
  }

  void SoughtConstants::hold_at_start(const std::vector<int> &held)
  {
    const std::vector<int> before = sought;
    std::vector<int>       columns;
    sought.clear();
    for (std::size_t k = 0; k < before.size(); ++k)
      if (std::find(held.begin(), held.end(), before[k]) == held.end())
        {
          sought.push_back(before[k]);
          columns.push_back(static_cast<int>(k));
        }
      else
        all[before[k]] = file.constants[before[k]].start;
    if (known_jacobian.size() > 0)
      known_jacobian = Eigen::MatrixXd(known_jacobian(Eigen::all, columns));
  }

  void SoughtConstants::seek_again(const std::vector<int> &held)
  {
    sought.insert(sought.end(), held.begin(), held.end());
    std::sort(sought.begin(), sought.end());
    known_jacobian = {};
  }

  void SoughtConstants::begin_at(const SoughtConstants &other)
  {
    all            = other.all;
    known_jacobian = other.known_jacobian;
  }

  optimisation::LeastSquaresProblem SoughtConstants::problem()
  {
    optimisation::LeastSquaresProblem made;
    const auto                        n = static_cast<Eigen::Index>(sought.size());
    made.start                          = all(sought);
    made.lower                          = Eigen::VectorXd(n);
    made.upper                          = Eigen::VectorXd(n);
    made.steps                          = file.step * ranges()(sought);
    for (Eigen::Index k = 0; k < n; ++k)
      {
        made.lower[k] = file.constants[sought[k]].lower;
        made.upper[k] = file.constants[sought[k]].upper;
      }
    made.residuals = [this](const std::vector<Eigen::VectorXd> &places) {
      std::vector<Eigen::VectorXd> sets;
      for (const Eigen::VectorXd &place : places)
        {
          sets.push_back(all);
          sets.back()(sought) = place;
        }
      auto values = runs.predicted(sets);
      for (auto &own : values)
        if (own)
          own = (*own - runs.measured()).cwiseQuotient(runs.scale());
      return values;
    };
    made.first_jacobian = known_jacobian;
    return made;
  }

  std::optional<optimisation::LeastSquaresFit> SoughtConstants::here()
  {
    optimisation::LeastSquaresFit there;
    there.place       = all(sought);
    const auto answer = problem().residuals({there.place}).front();
    if (!answer)
      return std::nullopt;
    there.residuals = *answer;
    return there;
  }

  optimisation::LeastSquaresFit SoughtConstants::fit(const optimisation::LeastSquaresOptions &options)
  {
    const optimisation::LeastSquaresFit found = file.method == SearchMethod::least_squares ?
                                                  optimisation::least_squares(problem(), options) :
                                                  optimisation::direct_search(problem(), options);
    all(sought)                               = found.place;
    return found;
  }

  optimisation::ModelAtEnd SoughtConstants::at_end(const optimisation::LeastSquaresOptions &options,
                                                   const optimisation::LeastSquaresFit     &fit,
                                                   const optimisation::NoiseOptions        &noise)
  {
    optimisation::ModelAtEnd found = optimisation::model_at_end(problem(), options, fit, noise);
    all(sought)                    = found.place;
    known_jacobian                 = found.jacobian;
    return found;
  }
} // namespace apps
