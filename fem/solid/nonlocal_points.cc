#include "fem/solid/nonlocal_points.h"

namespace fem
{
  NonlocalPoints::NonlocalPoints(const DamagePlasticConcrete &law_)
    : law(law_)
  {
  }

  void NonlocalPoints::allocate(const std::size_t n_points)
  {
    committed.assign(n_points, {});
    trial.assign(n_points, {});
    flown.assign(n_points, {});
    driving.assign(n_points, 0.0);
    responses.assign(n_points, Voigt::Zero());
  }

  void NonlocalPoints::place(const std::vector<Eigen::Vector3d> &places, const std::vector<double> &volumes)
  {
    const double m = law.parameters().nonlocal_factor;
    weights        = NonlocalWeights(places, volumes, law.parameters().nonlocal_length);
    coupled.assign(places.size(), {});
    for (std::size_t i = 0; i < places.size(); ++i)
      {
        coupled[i] = weights.row(i);
        for (auto &[j, weight] : coupled[i])
          weight = m * weight + (j == i ? 1 - m : 0.0);
      }
  }

  void NonlocalPoints::flow(const std::size_t point, const Voigt &strain, const bool with_tangent)
  {
    flown[point] = law.flow(strain, committed[point], with_tangent);
  }

  void NonlocalPoints::average()
  {
    for (std::size_t i = 0; i < flown.size(); ++i)
      driving[i] = flown[i].kappa_d;
    driving = weights.averaged(driving, law.parameters().nonlocal_factor);
  }

  void NonlocalPoints::evaluate(const std::size_t    point,
                                const Voigt         &strain,
                                const ElementExtent &element,
                                const bool           with_tangent,
                                PointAnswer         &answer)
  {
    const auto done = law.damage(flown[point], driving[point], strain, committed[point], element, with_tangent);
    trial[point]    = done.response.trial;
    answer.stress   = done.response.stress;
    if (!with_tangent)
      return;
    answer.tangent   = done.response.tangent;
    responses[point] = trial[point].damage > committed[point].damage ? done.stress_by_driving : Voigt::Zero();
  }

  void
  NonlocalPoints::set_initial(const std::size_t point, const InitialPointState &given, const ElementExtent &element)
  {
    trial[point] = committed[point] = law.initial_state(given, element);
  }

  void NonlocalPoints::visit(const std::size_t point, const StateColumn &column)
  {
    DamagePlasticConcrete::describe_state(committed[point], column);
    trial[point] = committed[point];
  }
}
