#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace coupling
{
  /**
   * The part of preCICE 3 that an adapter uses, under its own names (precice::Participant). Values of vertices stand one vertex after the other, with
   * as many numbers each as the mesh has dimensions.
   */
  class PreciceInterface
  {
  public:
    virtual ~PreciceInterface() = default;

    virtual int              mesh_dimensions(const std::string &mesh) const                                   = 0;
    virtual std::vector<int> set_mesh_vertices(const std::string &mesh, const std::vector<double> &positions) = 0;
    virtual bool             requires_initial_data()                                                          = 0;
    virtual void             initialize()                                                                     = 0;
    virtual bool             is_coupling_ongoing() const                                                      = 0;
    virtual double           max_time_step_size() const    = 0; ///< [s]
    virtual bool             requires_writing_checkpoint() = 0;
    virtual bool             requires_reading_checkpoint() = 0;

    /** @param relative_time in the time step to come [s] */
    virtual std::vector<double> read_data(const std::string      &mesh,
                                          const std::string      &data,
                                          const std::vector<int> &vertices,
                                          double                  relative_time) const = 0;

    virtual void write_data(const std::string         &mesh,
                            const std::string         &data,
                            const std::vector<int>    &vertices,
                            const std::vector<double> &values) = 0;

    virtual void advance(double time_step) = 0; ///< [s]
    virtual void finalize()                = 0;
  };

  /** Makes one. @param participant its name @param configuration file of preCICE */
  using JoinPrecice =
    std::function<std::unique_ptr<PreciceInterface>(const std::string &participant, const std::string &configuration)>;
} // namespace coupling
