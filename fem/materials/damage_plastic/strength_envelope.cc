#include "fem/materials/damage_plastic/strength_envelope.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fem
{
  namespace
  {
    using Law = DamagePlasticConcrete;

    /** A point on a proportional path: stress = factor * direction. */
    struct OnPath
    {
      double      conjugate = 0; ///< direction . strain
      double      factor    = 0; ///< [Pa]
      base::Voigt strain    = base::Voigt::Zero();
      Law::State  state;
    };

    class ProportionalPath
    {
    public:
      ProportionalPath(const Law &law_, const base::Voigt &along)
        : law(law_)
        , direction(along)
        , unit(1e-6 * law_.elastic_stiffness()(0, 0))
      {
      }

      /** Newton for the strains and the load factor at the next conjugate strain; nothing if it does not converge. */
      std::optional<OnPath> next(const OnPath &from, const double step) const
      {
        using Square  = Eigen::Matrix<double, 7, 7>;
        using Row     = Eigen::Matrix<double, 7, 1>;
        OnPath now    = from;
        now.conjugate = from.conjugate + step;
        try
          {
            for (int iteration = 0; iteration < 40; ++iteration)
              {
                const auto answer = law.evaluate(now.strain, from.state, ElementExtent{});
                Row        residual;
                residual.head<6>() = answer.stress - now.factor * direction;
                residual[6]        = unit * 1e6 * (direction.dot(now.strain) - now.conjugate);
                if (residual.norm() < 1e-10 * unit)
                  {
                    now.state = answer.trial;
                    return now;
                  }
                Square jacobian                   = Square::Zero();
                jacobian.topLeftCorner<6, 6>()    = answer.tangent;
                jacobian.topRightCorner<6, 1>()   = -direction;
                jacobian.bottomLeftCorner<1, 6>() = unit * 1e6 * direction.transpose();
                const Row correction              = jacobian.fullPivLu().solve(-residual);
                now.strain += correction.head<6>();
                now.factor += correction[6];
              }
          }
        catch (const MaterialFailure &)
          {
          }
        return std::nullopt;
      }

      /** The peak between two points of the path, the first of which lies before it. */
      struct Bracket
      {
        OnPath before, peak;
        double step = 0;
      };

      /** Go on until the factor has fallen. */
      std::optional<Bracket> pass_peak(const OnPath &from, double step) const
      {
        constexpr int most = 20000;
        Bracket       found{from, from, step};
        OnPath        last = from;
        for (int i = 0; i < most && step > 1e-16; ++i)
          {
            const auto reached = next(last, step);
            if (!reached)
              {
                step /= 2;
                continue;
              }
            if (reached->factor < found.peak.factor)
              return found;
            found = {last, *reached, step};
            last  = *reached;
          }
        return std::nullopt;
      }

    private:
      const Law  &law;
      base::Voigt direction;
      double      unit; ///< [Pa], the stress of a strain of 1e-6
    };
  } // namespace

  EnvelopePoint strength_towards(const Law &law, const double angle)
  {
    base::Voigt direction = base::Voigt::Zero();
    direction[0]          = std::cos(angle);
    direction[1]          = std::sin(angle);
    const ProportionalPath path(law, direction);
    double                 step = 2e-6; // a fiftieth of the strain at which concrete cracks
    OnPath                 start;
    for (int round = 0; round < 4; ++round, step /= 8)
      {
        const auto found = path.pass_peak(start, step);
        if (!found)
          throw base::NumericalError("strength at " + base::number_text(angle * 180 / 3.14159265358979) +
                                     " degrees: no peak was found.");
        if (round == 3)
          return {angle,
                  found->peak.factor * direction[0],
                  found->peak.factor * direction[1],
                  found->peak.strain[0],
                  found->peak.strain[1],
                  found->peak.strain[2],
                  found->peak.state.kappa_p};
        start = found->before;
      }
    throw std::logic_error("the last round returns");
  }

  std::vector<EnvelopePoint> biaxial_envelope(const Law &law, const int directions)
  {
    std::vector<EnvelopePoint> points;
    for (int i = 0; i < directions; ++i)
      points.push_back(strength_towards(law, 2 * 3.14159265358979323846 * i / directions));
    return points;
  }
} // namespace fem
