#pragma once

#include "base/state.h"
#include "coupling/participants/participant.h"
#include "coupling/precice/interface.h"

#include <cstdint>

namespace coupling
{
  /** Data of a mesh of preCICE by what they mean; "": there are none. */
  struct PreciceData
  {
    std::string force;        ///< on each vertex [N]; over conservative maps
    std::string displacement; ///< since the start [m]; over consistent ones
    std::string velocity;     ///< [m/s], half a step back; likewise

    bool any() const { return !(force.empty() && displacement.empty() && velocity.empty()); }
  };

  /** The carriers of a participant that are the vertices of a mesh, and what is exchanged there. */
  struct PreciceMesh
  {
    std::string              name;
    std::vector<std::size_t> carriers;
    PreciceData              reads, writes;

    /** Whether motion is read, and not force: the carriers are driven. */
    bool leads() const { return reads.force.empty(); }
    /**
     * Either force is read and motion is written, or one kind of motion is read and force is written.
     * @return what is wrong; "": nothing
     */
    std::string mistake() const;
  };

  /**
   * A body as a participant of preCICE (doc/tutorials/precice.md): forces push its carriers during a whole time window, or they are driven
   * evenly to where another code wants them. Windows that an implicit coupling takes back leave no trace.
   */
  class PreciceExchange
  {
  public:
    /** @param body must outlive it; driven carriers are held from now on @throws base::InputError by PreciceMesh::mistake() */
    PreciceExchange(Participant &body, PreciceMesh mesh, std::function<std::unique_ptr<PreciceInterface>()> join);

    /**
     * To the end of the next time window, in as many iterations as it takes; before the first one, wait for the others. @pre !is_over()
     * @throws what the body and the interface throw
     */
    void advance();
    bool is_over() const { return over; }

    std::int64_t windows() const { return windows_taken; }
    std::int64_t iterations() const { return iterations_taken; } ///< of all windows

    /** What is neither the body's nor preCICE's, which is joined anew after reading. */
    void visit_state(base::StateVisitor &visitor);

  private:
    void start();
    void read(double window);
    void write();
    /** Of all carriers, as the mesh has them. @param quantity of carrier k */
    template <typename Quantity>
    std::vector<double> flat(const Quantity &quantity) const;

    Participant                                       &body;
    PreciceMesh                                        mesh;
    std::function<std::unique_ptr<PreciceInterface>()> join;
    std::unique_ptr<PreciceInterface>                  interface; ///< once it has started
    std::size_t                                        dimensions = 0;
    std::vector<int>                                   vertices;
    std::vector<std::size_t>                           groups; ///< one for each driven carrier
    base::Column                                       places; ///< of the carriers at the start, x, y, z each [m]
    std::int64_t                                       windows_taken = 0, iterations_taken = 0;
    bool                                               over = false;
  };
} // namespace coupling
