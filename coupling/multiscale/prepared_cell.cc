#include "coupling/multiscale/prepared_cell.h"

#include "base/errors.h"
#include "dem/homogenisation/resisted_strains.h"

#include <omp.h>

#include <algorithm>
#include <cmath>

namespace coupling
{
  PreparedCell::PreparedCell(const dem::Packing       &packing,
                             const dem::LinkMaterials &materials,
                             const CellParameters     &parameters)
  {
    if (!packing.periodic_cell)
      throw base::InputError("cells: the packing has no periodic cell. Take one of breccia pack, or the generator.");
    edges                       = *packing.periodic_cell;
    dem::ElasticNetwork   links = dem::make_network(packing, parameters.links, materials);
    dem::SolverParameters solver;
    solver.tolerance               = 1e-13;
    dem::RelaxedStiffness solution = dem::relaxed_stiffness(links, solver);
    const int             strains  = dem::strains_of(parameters.links.dimension);
    if (solution.resisted < strains)
      throw base::InputError("cells: the packing resists only " + std::to_string(solution.resisted) + " of " +
                             std::to_string(strains) +
                             " strains. Raise the interaction ratio, or take a denser packing.");
    if (links.dimension == 2)
      for (const int out_of_plane : {2, 3, 4})
        solution.stiffness(out_of_plane, out_of_plane) = solution.stiffness(5, 5);
    if (!parameters.from_start)
      range.emplace(links, materials, solution, parameters.promotion);
    relaxed =
      std::make_shared<dem::ElasticResponse>(dem::ElasticResponse{solution.stiffness, std::move(solution.motion)});
    network = std::make_shared<dem::LoadedNetwork>(dem::strained_cell(std::move(links)));
    for (int thread = 0; thread < omp_get_num_procs() || thread < omp_get_max_threads(); ++thread)
      systems.emplace_back(*network); // costs nothing until it is used
    dem::CellResponseParameters response = parameters.response;
    response.keeps_its_way               = true; // the structure's Newton iterations seek a strain
    virgin =
      std::make_unique<dem::RespondingCell>(network, materials, response, parameters.only_solved ? nullptr : relaxed);
  }

  base::Stiffness PreparedCell::in_space(const base::Stiffness &of_cell) const
  {
    base::Stiffness whole = of_cell;
    if (of_discs())
      for (const int out_of_plane : {2, 3, 4})
        whole(out_of_plane, out_of_plane) = stiffness()(5, 5);
    return whole;
  }

  std::unique_ptr<dem::RespondingCell> PreparedCell::promoted_at(const base::Voigt &strain,
                                                                 dem::CellSystem   &system) const
  {
    auto cell = std::make_unique<dem::RespondingCell>(*virgin);
    if (!strain.isZero(0))
      {
        cell->respond(strain, system, false);
        cell->commit();
      }
    return cell;
  }

  dem::CellSystem &PreparedCell::system_of_thread(const int thread) const
  {
    return systems.at(static_cast<std::size_t>(thread));
  }

  double PreparedCell::length_along(const Eigen::Vector3d &normal) const
  {
    return (normal.cwiseAbs().cwiseProduct(edges)).maxCoeff();
  }
} // namespace coupling
