#include "coupling/sequential/strained_specimen.h"

#include "coupling/sequential/damage_observation.h"
#include "dem/observation/discrete_state.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace coupling
{
  namespace
  {
    constexpr std::int64_t most_samples = 1000; ///< to the furthest strain
  }

  StrainedSpecimen::StrainedSpecimen(const dem::Packing            &packing,
                                     const dem::SpecimenParameters &parameters,
                                     const dem::LinkMaterials      &materials,
                                     const dem::UniaxialParameters &strained,
                                     const DamageObserver          &observes)
    : observer(observes)
    , axis(strained.axis)
    , specimen(packing, parameters, materials)
    , test(specimen, strained)
  {
  }

  void StrainedSpecimen::advance()
  {
    const dem::UniaxialSample sample = test.advance(std::max<std::int64_t>(1, test.most_steps() / most_samples));
    const ParticleField       field  = particle_field(dem::discrete_state(specimen), observer.field);
    taken.push_back(
      {sample.strain, sample.stress, observed_damage(field, observer.averaging, axis, observer.element_size)});
  }

  double StrainedSpecimen::done() const
  {
    return std::min(1.0, static_cast<double>(specimen.steps()) / static_cast<double>(test.most_steps()));
  }

  void StrainedSpecimen::visit_state(base::StateVisitor &visitor)
  {
    specimen.visit_state(visitor);
    test.visit_state(visitor);
    base::Column flat;
    for (const Sample &s : taken)
      {
        flat.insert(flat.end(), {s.strain, s.stress});
        flat.insert(flat.end(), s.damage.data(), s.damage.data() + 9);
      }
    visitor.column("samples", flat);
    taken.resize(flat.size() / 11);
    for (std::size_t i = 0; i < taken.size(); ++i)
      taken[i] = {flat[11 * i], flat[11 * i + 1], Eigen::Map<const Eigen::Matrix3d>(&flat[11 * i + 2])};
  }

  SpecimenIdentification identify(const std::vector<StrainedSpecimen::Sample> &samples,
                                  const fem::MaterialConstants                &material,
                                  const double                                 element_size,
                                  const bool                                   compression)
  {
    using Sample         = StrainedSpecimen::Sample;
    const auto   weaker  = [](const Sample &a, const Sample &b) { return std::abs(a.stress) < std::abs(b.stress); };
    const auto   peak    = std::max_element(samples.begin(), samples.end(), weaker);
    const double largest = std::abs(peak->stress);

    std::vector<ParticleObservation> observations;
    for (auto s = samples.begin(); s != samples.end(); ++s)
      observations.push_back({s->damage, std::abs(s->stress) / largest, s > peak});
    const ContinuumReference reference(material, element_size, compression, compression ? 1e-5 : 1e-6, 0.05);
    return {identify(observations, reference, {}), largest, observations, reference};
  }
} // namespace coupling
