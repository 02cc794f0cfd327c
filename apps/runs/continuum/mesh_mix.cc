#include "apps/runs/continuum/mesh_mix.h"

#include "apps/results/warning.h"
#include "apps/specimens/mix_work.h"
#include "base/errors.h"
#include "fem/mesh/regroup.h"

#include <fmt/format.h>

namespace apps
{
  namespace
  {
    template <int dim>
    void share(fem::Mesh<dim> &mesh, const MixSection &mix, const std::string &group)
    {
      const fem::Extent<dim> around = fem::extent_of(mesh, group);
      MixBox                 box;
      for (int d = 0; d < dim; ++d)
        box.edges[d] = around.high[d] - around.low[d];
      if (dim == 2)
        box = {mix.box_behind(box.edges), true};
      const MixFigures figures = mix_figures(mix, box);
      const auto       counts  = fem::regroup<dim>(
        mesh, group, {mix.mortar, mix.aggregate}, [&](const std::vector<dealii::Point<dim>> &middles) {
          std::vector<Eigen::Vector3d> places;
          for (const dealii::Point<dim> &middle : middles)
            {
              Eigen::Vector3d &place = places.emplace_back(0, 0, 0);
              for (int d = 0; d < dim; ++d)
                place[d] = middle[d] - around.low[d];
            }
          std::vector<std::size_t> numbers;
          for (const std::int32_t aggregate : dem::aggregates_at(figures.placed.structure, places))
            numbers.push_back(aggregate == dem::in_mortar ? 0 : 1);
          return numbers;
        });
      if (counts[1] == 0)
        throw base::InputError("the middle of no element lies in an aggregate: make elements smaller than these are.");
      give_note(fmt::format("mix: {}; {} of {} elements", figures.text(), counts[1], counts[0] + counts[1]));
    }
  } // namespace

  template <int dim>
  void MeshMixSection::share_out(fem::Mesh<dim> &mesh) const
  {
    try
      {
        share(mesh, mix, group);
      }
    catch (const base::InputError &refusal)
      {
        throw base::InputError(std::string("Mesh/Mix: ") + refusal.what());
      }
  }

  template void MeshMixSection::share_out(fem::Mesh<2> &) const;
  template void MeshMixSection::share_out(fem::Mesh<3> &) const;
} // namespace apps
