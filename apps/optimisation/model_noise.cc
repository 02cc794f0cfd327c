#include "apps/optimisation/model_noise.h"

#include "apps/optimisation/evaluated_residuals.h"

#include <Eigen/QR>

#include <cmath>
#include <optional>
#include <vector>

namespace optimisation
{
  namespace
  {
    /** Residuals at five equally spaced places on a line through a place. */
    class Line
    {
    public:
      /** As far as steps and bounds let both sides go; variables on a bound stay. Nothing where an answer lacks, or all lie on bounds. */
      static std::optional<Line> through(const Eigen::VectorXd     &place,
                                         const LeastSquaresProblem &problem,
                                         const Eigen::VectorXd     &steps,
                                         EvaluatedResiduals        &evaluated)
      {
        const Eigen::VectorXd way = steps.cwiseMin(place - problem.lower).cwiseMin(problem.upper - place);
        if (way.isZero(0))
          return std::nullopt;
        Line line;
        for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0})
          line.places.push_back(evaluated.within_bounds(place + part * way));
        evaluated.prepare(line.places);
        for (const Eigen::VectorXd &each : line.places)
          {
            const auto answer = evaluated.at(each);
            if (!answer)
              return std::nullopt;
            line.answers.push_back(*answer);
          }
        return line;
      }

      /** The fourth difference: 70 times the variance of one answer's noise. */
      Eigen::VectorXd noise() const { return sum({1, -4, 6, -4, 1}) / std::sqrt(70.0); }

      static constexpr double share = 17.0 / 35; ///< of the variance of one answer's noise in smooth()
      /** At the middle, of a parabola through the others. */
      Eigen::VectorXd smooth_without_middle() const { return sum({-1, 4, 0, 4, -1}) / 6; }
      /** At the middle, of the parabola of least squares through all (A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964) 1627, table I). */
      Eigen::VectorXd smooth() const { return sum({-3, 12, 17, 12, -3}) / 35; }

    private:
      Eigen::VectorXd sum(const std::vector<double> &weights) const
      {
        Eigen::VectorXd all = Eigen::VectorXd::Zero(answers.front().size());
        for (std::size_t k = 0; k < weights.size(); ++k)
          all += weights[k] * answers[k];
        return all;
      }

      std::vector<Eigen::VectorXd> places, answers;
    };

    double root_mean_square(const Eigen::VectorXd &values)
    {
      return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
    }

    /**
     * r(x + h) - 2 r(x) + r(x - h) has six times the variance. Variables too near a bound have none, nor have those in which the model is so
     * curved that it would be taken for noise.
     * @param size of noise that is free of curvature, root mean square
     */
    Eigen::MatrixXd noise_by_variable(const LeastSquaresProblem &problem,
                                      EvaluatedResiduals        &evaluated,
                                      const Eigen::VectorXd     &place,
                                      const double               size)
    {
      constexpr double      curved = 2;
      const Eigen::VectorXd here   = *evaluated.at(place);
      Eigen::MatrixXd       found(here.size(), 0);
      for (Eigen::Index k = 0; k < place.size(); ++k)
        {
          Eigen::VectorXd up = place, down = place;
          up[k] += problem.steps[k];
          down[k] -= problem.steps[k];
          if (down[k] < problem.lower[k] || up[k] > problem.upper[k])
            continue;
          const auto above = evaluated.at(up), below = evaluated.at(down);
          if (!above || !below)
            continue;
          const Eigen::VectorXd draw = (*above + *below - 2 * here) / std::sqrt(6.0);
          if (root_mean_square(draw) > curved * size)
            continue;
          found.conservativeResize(Eigen::NoChange, found.cols() + 1);
          found.rightCols(1) = draw;
        }
      return found;
    }

    void append(const Eigen::VectorXd &draw, ModelAtEnd &found)
    {
      found.noise.conservativeResize(draw.size(), found.noise.cols() + 1);
      found.noise.rightCols(1) = draw;
      found.noise_degrees += 1;
    }

    /** Draws that share the answer in the middle: a correlation of two thirds makes them worth fewer. */
    void append_all(const Eigen::MatrixXd &draws, ModelAtEnd &found)
    {
      constexpr double correlation = 2.0 / 3;
      const auto       count       = static_cast<double>(draws.cols());
      if (draws.cols() == 0)
        return;
      const double before = found.noise_degrees;
      for (Eigen::Index k = 0; k < draws.cols(); ++k)
        append(draws.col(k), found);
      found.noise_degrees = before + count / (1 + (count - 1) * correlation * correlation);
    }

    double deviation_of(const LeastSquaresFit &fit, const double known)
    {
      const auto degrees = static_cast<double>(fit.residuals.size() - fit.place.size());
      return known > 0 ? known : degrees > 0 ? std::sqrt(fit.sum_of_squares() / degrees) : 0;
    }

    std::vector<int> on_bounds(const LeastSquaresProblem &problem, const Eigen::VectorXd &place)
    {
      std::vector<int> held;
      for (int k = 0; k < place.size(); ++k)
        if (place[k] <= problem.lower[k] || place[k] >= problem.upper[k])
          held.push_back(k);
      return held;
    }

    /** Of Gauss and Newton, in variables that do not lie on a bound, no farther than a few wide steps. */
    Eigen::VectorXd stepped(const LeastSquaresProblem &problem,
                            const Eigen::VectorXd     &place,
                            const Eigen::MatrixXd     &jacobian,
                            const Eigen::VectorXd     &residuals)
    {
      constexpr double most = 2; // beyond, the straight lines of the derivatives no longer hold
      std::vector<int> free;
      for (int k = 0; k < place.size(); ++k)
        if (place[k] > problem.lower[k] && place[k] < problem.upper[k])
          free.push_back(k);
      if (free.empty())
        return place;
      const Eigen::VectorXd units = problem.steps(free);
      Eigen::VectorXd step = -(jacobian(Eigen::all, free) * units.asDiagonal()).colPivHouseholderQr().solve(residuals);
      step /= std::max(1.0, step.cwiseAbs().maxCoeff() / most);
      Eigen::VectorXd there = place;
      there(free) += step.cwiseProduct(units);
      return there.cwiseMax(problem.lower).cwiseMin(problem.upper);
    }

    /**
     * In steps of the problem, by the derivatives at a place: of what was measured, and of the noise of an answer.
     * @param residuals there @param noise draws, a column each @param known deviation of a residual; 0: what no variable can take off them
     */
    Eigen::VectorXd standard_errors(const LeastSquaresProblem &problem,
                                    const Eigen::MatrixXd     &jacobian,
                                    const Eigen::VectorXd     &residuals,
                                    const Eigen::MatrixXd     &noise,
                                    const double               known)
    {
      const Eigen::MatrixXd by_steps = jacobian * problem.steps.asDiagonal();
      const auto            solver   = by_steps.completeOrthogonalDecomposition();
      const Eigen::MatrixXd inverse = solver.pseudoInverse(); // zero for variables on a bound, as their derivatives are
      const auto            degrees = static_cast<double>(residuals.size() - solver.rank());
      const double          left    = (residuals - by_steps * (inverse * residuals)).squaredNorm();
      const double          variance = known > 0 ? known * known : degrees > 0 ? left / degrees : 0;
      const Eigen::VectorXd by_noise = (inverse * noise).rowwise().squaredNorm() / static_cast<double>(noise.cols());
      return (variance * inverse.rowwise().squaredNorm() + by_noise).cwiseSqrt();
    }

    /** Whether derivatives that were taken at a place hold at the next one: half a step away, or within what constants are known to. */
    bool hold_at(const Eigen::VectorXd &way_in_steps, const Eigen::VectorXd &errors_in_steps)
    {
      constexpr double near = 0.5;
      return (way_in_steps.cwiseAbs().array() <= errors_in_steps.array().max(near)).all();
    }

    /** With the noise that the place will have been found from. */
    ModelAtEnd as_smoothed(ModelAtEnd so_far, const int evaluations)
    {
      so_far.share       = Line::share;
      so_far.evaluations = evaluations;
      return so_far;
    }

    /**
     * How much larger squares of an answer may be by noise alone than those of a search that took the smallest it met.
     * @param residuals of the search @param noise draws, a column each
     */
    double by_chance(const Eigen::VectorXd &residuals, const Eigen::MatrixXd &noise)
    {
      constexpr double deviations = 3;
      const double     variance = 2 * (noise.transpose() * residuals).squaredNorm() / static_cast<double>(noise.cols());
      return 2 * deviations * std::sqrt(variance) + 2 * noise.colwise().squaredNorm().mean();
    }

    /** Of one more round of central differences and a line, and of the answer; the place itself is counted, but not run. */
    int evaluations_of_round(const LeastSquaresProblem &problem, const Eigen::VectorXd &place)
    {
      const auto free = place.size() - static_cast<Eigen::Index>(on_bounds(problem, place).size());
      return 2 * static_cast<int>(free) + 5 + 1;
    }

    /** @param wide the problem with wide steps, which begins at the end of the search @param first line through that */
    void put_right(const LeastSquaresProblem &wide,
                   EvaluatedResiduals        &evaluated,
                   const Line                &first,
                   const NoiseOptions        &options,
                   ModelAtEnd                &found)
    {
      constexpr int   most_repeats = 4;
      Eigen::MatrixXd jacobian_of_search;
      double          column_of_search = 0;
      Eigen::VectorXd place = found.place, residuals = first.smooth_without_middle();
      append(first.noise(), found);
      for (int round = 0; round < most_repeats; ++round)
        {
          const int so_far = evaluated.evaluations() - 1; // the place itself belongs to the search
          found.cut_short  = round > 0 && so_far + evaluations_of_round(wide, place) > options.most_evaluations;
          if (found.cut_short)
            break;
          evaluated.leave_out(on_bounds(wide, place)); // they stay there, and have no error
          const auto jacobian = evaluated.jacobian(place);
          if (!jacobian)
            return;
          found.jacobian  = *jacobian;
          found.of_column = found.noise.colwise().squaredNorm().mean() / 2; // of a difference over two steps
          if (round == 0)
            {
              jacobian_of_search = found.jacobian;
              column_of_search   = found.of_column;
            }
          append_all(noise_by_variable(wide, evaluated, place, root_mean_square(first.noise())), found);
          if (round == 0 && options.goes_on && !options.goes_on(as_smoothed(found, evaluated.evaluations() - 1)))
            return;
          const Eigen::VectorXd next = stepped(wide, place, *jacobian, residuals);
          const auto            line = Line::through(next, wide, wide.steps, evaluated);
          if (!line)
            return;
          append(line->noise(), found);
          const bool hold = hold_at((next - place).cwiseQuotient(wide.steps),
                                    standard_errors(wide, *jacobian, residuals, found.noise, options.deviation));
          place           = next;
          residuals       = line->smooth();
          if (hold)
            break;
        }
      const Eigen::VectorXd last   = stepped(wide, place, found.jacobian, residuals);
      const auto            answer = evaluated.at(last);
      // A worse answer is that of derivatives that do not hold.
      if (answer && answer->squaredNorm() <= found.residuals.squaredNorm() + by_chance(found.residuals, found.noise))
        {
          found.place     = last;
          found.residuals = *answer;
          found.share     = Line::share;
          return;
        }
      found.leads_astray = true; // so it is the search's answer, with derivatives of its own
      found.jacobian     = jacobian_of_search;
      found.of_column    = column_of_search;
      found.cut_short    = false;
    }
  } // namespace

  ModelAtEnd model_at_end(const LeastSquaresProblem &problem,
                          const LeastSquaresOptions &options,
                          const LeastSquaresFit     &fit,
                          const NoiseOptions        &noise)
  {
    ModelAtEnd          found;
    LeastSquaresProblem here = problem;
    here.start               = fit.place;
    here.first_jacobian      = {};
    found.place              = fit.place;
    found.residuals          = fit.residuals;
    if (noise.search != NoiseSearch::never)
      {
        LeastSquaresProblem wide    = here;
        LeastSquaresOptions central = options;
        wide.steps                  = noise.wide_steps;
        central.central_differences = true;
        central.updated_jacobian    = false;
        EvaluatedResiduals evaluated(wide, central);
        const double       deviation = deviation_of(fit, noise.deviation);
        if (const auto line = Line::through(fit.place, wide, wide.steps, evaluated))
          {
            const double size   = root_mean_square(line->noise());
            found.largest_noise = deviation > 0 ? size / deviation : 0;
            if (noise.search == NoiseSearch::always || size > noise.of_concern * deviation)
              put_right(wide, evaluated, *line, noise, found);
          }
        found.evaluations += evaluated.evaluations() - 1; // the place itself belongs to the search
        found.failed += evaluated.failed();
      }
    if (found.jacobian.size() > 0)
      return found;
    EvaluatedResiduals evaluated(here, options);
    if (const auto jacobian = evaluated.jacobian(fit.place))
      found.jacobian = *jacobian;
    found.evaluations += evaluated.evaluations() - 1;
    found.failed += evaluated.failed();
    return found;
  }
} // namespace optimisation
