#pragma once

#include "coupling/multiscale/crack_band.h"
#include "coupling/multiscale/dealt_points.h"
#include "coupling/multiscale/localisations.h"
#include "coupling/multiscale/prepared_cell.h"
#include "fem/points/gathered_points.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace coupling
{
  /** What becomes of a cell whose tangent has lost ellipticity. */
  enum class Localised
  {
    stop,       ///< the run ends with that state
    crack_band, ///< it goes on as a layer of its element
    refuse,     ///< such a state is none: the solver seeks another, with shorter steps
    go_on       ///< without regularisation: what follows depends on the size of the elements
  };

  /** How points are given cells. */
  struct CellPointsParameters
  {
    std::vector<std::shared_ptr<const PreparedCell>>
              cells; ///< at least one; points take them in turn, by their number in the mesh
    Localised localised     = Localised::stop;
    bool      large_strains = false;         ///< strains are Green's: see Stretch; a solid says so itself
    bool      plane         = false;         ///< the model is plane: bands stand upright on it; likewise
    MPI_Comm  communicator  = MPI_COMM_SELF; ///< of ranks that all hold the same structure, and share its cells
  };

  /**
   * Integration points whose answer is that of a cell of particles: of its elastic stiffness until some link could leave elasticity, and
   * from then on of the particles in equilibrium (doc/theory/multiscale.md). Only those that have left it take memory. Cells are
   * spread over threads, and dealt out to ranks that all hold the whole structure and do the same with it, with the same bits for any
   * number of either.
   */
  class CellPoints : public fem::GatheredPoints
  {
  public:
    /** Columns of a point's history. */
    struct Record
    {
      double      promoted  = 0; ///< 1: the particles answer
      double      since     = 0; ///< number of the state in which they took over, the first loaded one is 1
      double      damage    = 0; ///< mean over the links
      double      localised = 0; ///< 1: the tangent has lost ellipticity
      base::Voigt strain    = base::Voigt::Zero(); ///< that the cell saw in the committed state

      friend bool operator==(const Record &a, const Record &b)
      {
        return a.promoted == b.promoted && a.since == b.since && a.damage == b.damage && a.localised == b.localised &&
               a.strain == b.strain;
      }
    };

    /** @throws base::InputError for spheres in plane stress, which is not built; discs know of no difference */
    CellPoints(CellPointsParameters parameters, fem::Plane plane);

    const char *material_name() const override { return name; }
    /** Of the cells; of several that of the first, scaled so that none is stiffer in any strain. */
    const base::Stiffness &elastic_stiffness() const override { return stiffest; }
    bool                   linear() const override { return false; }
    bool                   takes_large_strains() const override { return true; }
    bool                   takes_initial_state() const override { return false; }
    void                   allocate(std::size_t n_points) override;
    void                   place(std::vector<Site> sites, const Setting &setting) override;
    void                   gather(const std::vector<base::Voigt> &strains, bool with_tangent) override;
    void                   begin_step() override;
    void                   evaluate(std::size_t               point,
                                    const base::Voigt        &strain,
                                    const fem::ElementExtent &element,
                                    bool                      with_tangent,
                                    fem::PointAnswer         &answer) override;
    void                   commit() override;
    void        set_initial(std::size_t, const fem::InitialPointState &, const fem::ElementExtent &) override;
    std::string end_of_validity() const override { return localised.end_of_validity(); }
    std::vector<std::string> notes() const override { return localised.notes(); }

    std::vector<fem::PointQuantity> quantities() const override;
    void                            visit(std::size_t point, const fem::StateColumn &column) override;
    bool                            remembers_more() const override { return true; }
    void                            visit_more(base::StateVisitor &visitor) override;

    double stored_energy(std::size_t point, const base::Voigt &strain, const base::Voigt &stress) const override;
    fem::Dissipation dissipated(std::size_t point, const fem::ElementExtent &element) const override;

    std::size_t                      promoted() const; ///< of the committed state
    const std::vector<Localisation> &localisations() const { return localised.all(); }
    const Record                    &record(const std::size_t point) const { return points.at(point).record; }
    /** nullptr while it is elastic. */
    const dem::RespondingCell *cell(const std::size_t point) const { return points.at(point).cell.get(); }
    /** nullptr while it is not a layer of its element. */
    const CrackBand *band(const std::size_t point) const
    {
      return points.at(point).band ? &*points.at(point).band : nullptr;
    }

    static constexpr const char *name = "cells";
    /** Column of the record that says since when. */
    static constexpr const char *promoted_in_state = "promoted_in_state";

    /** The columns of a record. */
    static void describe(Record &record, const fem::StateColumn &column);

  private:
    struct Point
    {
      Record                               record;
      std::shared_ptr<const PreparedCell>  prepared;
      std::unique_ptr<dem::RespondingCell> cell;  ///< of a promoted point of this rank
      std::unique_ptr<dem::RespondingCell> fresh; ///< that would take over, should the trial be committed
      std::optional<CrackBand>             band;
      base::Voigt                          stress = base::Voigt::Zero(); ///< of the law, of the committed state
      double                               stored = 0; ///< by a promoted point, of the committed state [J/m^3]

      // The trial; all ranks know it.
      bool             known = false, has_tangent = false, is_promoted = false;
      base::Voigt      strain = base::Voigt::Zero(), law_strain = base::Voigt::Zero();
      fem::PointAnswer answer, of_law; ///< as the solid wants it, and for the strain that the law sees
      std::string      failure;
      fem::Dissipation lost; ///< from the committed state to it, once it was requested
    };

    /** What becomes of a promoted point when its trial is committed. */
    struct News
    {
      double          damage = 0, stored = 0;
      Eigen::Vector3d normal = {0, 0, 0}; ///< of the plane in which ellipticity has just been lost; zero: it has not
      std::string     failure;            ///< of that which should have followed

      void visit(base::StateVisitor &visitor);
    };

    bool is_mine(const std::size_t number) const { return dealt.has(sites[number].number); }
    /** Notes a request to a point. @return whether the answer is still to be found */
    bool        request(Point &point, const base::Voigt &strain, bool with_tangent);
    void        answer_to(const std::vector<std::size_t> &requested);
    void        share_answers(const std::vector<std::size_t> &requested);
    static void visit_answer(Point &point, base::StateVisitor &visitor);
    void        complete_answer(Point &point) const;
    static void answer_elastically(Point &point);
    void        find(Point &point) const;
    void        respond_by_cell(Point &point) const;
    News        commit_cell(std::size_t number);
    void        share_news(const std::vector<std::size_t> &changed, std::vector<News> &news) const;
    /** The trial of a point becomes its state. @throws base::NumericalError */
    void take(std::size_t number, const News &news);
    /** The plane of a committed cell that has just lost ellipticity. */
    std::optional<Eigen::Vector3d> lost_plane(const Point &point, double damage) const;
    /** Of a committed cell, should it damage no further [Pa]. */
    static base::Stiffness unloading_of(const Point &point);
    /** What part of its element the cell of a point fills along a normal; above 1: it is the longer one. */
    double                  share_of_cell(std::size_t number, const Eigen::Vector3d &normal) const;
    void                    localise(std::size_t number, const Eigen::Vector3d &normal);
    double                  stored_now(const Point &point, const base::Voigt &strain) const;
    void                    find_losses() const;
    static fem::Dissipation losses_of(const Point &point);

    CellPointsParameters       parameters;
    base::Stiffness            stiffest;
    DealtPoints                dealt;
    mutable std::vector<Point> points; ///< `lost` is found on request
    mutable bool               losses_known = false;
    std::vector<Site>          sites;
    Localisations              localised;
    std::int64_t               states = 0; ///< committed so far
  };
} // namespace coupling
