#include "apps/runs/sequential/model.h"

#include <algorithm>
#include <limits>

namespace apps
{
  double SequentialModel::tensile_strength() const
  {
    double least = std::numeric_limits<double>::max();
    for (const MaterialOfGroup *group : receivers())
      least = std::min(least, group->chosen().constants->uniaxial_strengths().tension);
    return least;
  }

  std::vector<const MaterialOfGroup *> SequentialModel::receivers() const
  {
    std::vector<const MaterialOfGroup *> found;
    for (const auto &group : continuum.materials.groups)
      if (group->law->takes_initial_state())
        found.push_back(group.get());
    return found;
  }

  namespace
  {
    std::string names_of_receiving_laws()
    {
      std::string names;
      for (const auto &kind : fem::material_kinds())
        if (kind->takes_initial_state())
          names += (names.empty() ? "" : " or ") + kind->name();
      return names;
    }
  } // namespace

  void SequentialModel::check(const base::EntryPath &scene) const
  {
    particles.check(scene);
    transfer.check(scene);
    if (transfer.identifies() && particles.source == ParticleEventSection::Source::file)
      scene.at("Transfer")
        .at("Mapping law")
        .refuse(
          "Law",
          "saved states do not say what their particles are made of. Identify the law with the scene that made them "
          "(breccia transfer --identify), and give its constants: Law = own.");
    const base::EntryPath at_continuum = scene.at("Continuum");
    this->continuum.check(at_continuum);
    if (!continuum.is_static())
      at_continuum.at("Model").refuse("Analysis", "a transferred state is carried on in equilibrium: static.");
    if (particles.source != ParticleEventSection::Source::file &&
        particles.physics.dimension != continuum.solid.dimension)
      at_continuum.at("Model").refuse("Dimension", "must be that of the particles (Particles/Physics/Dimension).");
    if (study.sign != 1 && study.sign != -1)
      scene.at("Study").refuse("Sign", "must be 1 or -1.");
    if (receivers().empty())
      at_continuum.at("Materials")
        .refuse("Law",
                "at least one group must be " + names_of_receiving_laws() + ", or there is nothing to transfer to.");
  }
} // namespace apps
