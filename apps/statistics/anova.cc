#include "apps/statistics/anova.h"

#include "apps/statistics/distributions.h"
#include "base/errors.h"

#include <algorithm>
#include <limits>

namespace statistics
{
  namespace
  {
    /** The mean and the effects of all factors but one. */
    struct MainEffects
    {
      Eigen::MatrixXd          columns;
      std::vector<std::string> names;
    };

    MainEffects main_effects(const std::vector<Factor> &factors, const std::size_t left_out)
    {
      MainEffects model{Eigen::MatrixXd::Ones(factors.front().values.size(), 1), {"mean"}};
      for (std::size_t number = 0; number < factors.size(); ++number)
        {
          if (number == left_out)
            continue;
          const Levels          levels = levels_of(factors[number].values);
          const Eigen::MatrixXd own    = effect_columns(levels);
          model.columns.conservativeResize(Eigen::NoChange, model.columns.cols() + own.cols());
          model.columns.rightCols(own.cols()) = own;
          for (Eigen::Index level = 0; level < own.cols(); ++level)
            model.names.push_back(factors[number].name + " level " + std::to_string(level + 1));
        }
      return model;
    }

    void take_error_from(Anova &anova, const std::string &null_column)
    {
      const auto null = std::find_if(anova.effects.begin(), anova.effects.end(),
                                     [&](const Effect &effect) { return effect.factor == null_column; });
      if (null == anova.effects.end())
        throw base::InputError("analysis of variance: there is no column " + null_column + " to take as the error.");
      anova.error_sum     = null->sum_of_squares;
      anova.error_degrees = null->degrees;
      anova.effects.erase(null);
    }
  } // namespace

  Anova analyse_variance(const std::vector<Factor> &factors,
                         const Eigen::VectorXd     &response,
                         const std::string         &null_as_error)
  {
    const MainEffects all = main_effects(factors, factors.size());
    Anova             anova;
    anova.fit           = fit(all.columns, response, all.names);
    anova.error_sum     = anova.fit.error_sum;
    anova.error_degrees = anova.fit.error_degrees;
    anova.total_sum     = anova.fit.total_sum;
    for (std::size_t number = 0; number < factors.size(); ++number)
      {
        const MainEffects others  = main_effects(factors, number);
        const LinearFit   without = fit(others.columns, response, others.names);
        Effect            effect{factors[number].name, without.error_sum - anova.fit.error_sum,
                      without.error_degrees - anova.fit.error_degrees, 0, 0};
        anova.effects.push_back(effect);
      }
    if (!null_as_error.empty())
      take_error_from(anova, null_as_error);
    for (Effect &effect : anova.effects)
      {
        effect.f = anova.error_degrees > 0 && effect.degrees > 0 ?
                     (effect.sum_of_squares / effect.degrees) / (anova.error_sum / anova.error_degrees) :
                     std::numeric_limits<double>::quiet_NaN();
        effect.p = f_probability_above(effect.f, effect.degrees, anova.error_degrees);
      }
    return anova;
  }
} // namespace statistics
