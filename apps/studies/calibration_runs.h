#pragma once

#include "apps/results/run_result.h"
#include "apps/scene/scene.h"
#include "apps/studies/calibration_file.h"
#include "apps/studies/run_study.h"

#include <Eigen/Core>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace apps
{
  /** The process was requested to end while runs were going on. */
  struct CalibrationInterrupted
  {
  };

  /** Which of the models of a calibration is run. */
  enum class Fidelity
  {
    costly,
    cheap
  };

  /** What was measured, point by point in the order of the targets, and what runs with some constants give for it. */
  class CalibrationRuns
  {
  public:
    /**
     * @throws base::InputError for curves that cannot be read, and scenes that are refused at the start or at a bound; what is measured
     * by runs is not known before measure()
     */
    CalibrationRuns(const CalibrationFile &calibration,
                    const StudyOptions    &options,
                    Fidelity               fidelity = Fidelity::costly);

    /** Run the reference scenes that the folder does not hold. @throws base::InputError where one fails; CalibrationInterrupted */
    void measure();

    const Eigen::VectorXd &measured() const { return observed; }
    const Eigen::VectorXd &abscissae() const { return places; } ///< NaN of figures
    const Eigen::VectorXd &scale() const { return deviations; } ///< residuals are (predicted - measured) / scale
    Eigen::Index           first_of(std::size_t target) const { return begins[target]; }
    /** Abscissa and ordinate of a curve, "strain [-]", with the units that the table of what was measured names. */
    const std::pair<std::string, std::string> &labels_of(std::size_t target) const { return labels[target]; }

    /**
     * Of each set of constants; nothing where a run failed or has no such figure. Runs that the folder holds already are not repeated.
     * @throws base::InputError for a figure that no run has; CalibrationInterrupted
     */
    std::vector<std::optional<Eigen::VectorXd>> predicted(const std::vector<Eigen::VectorXd> &sets);

    int runs() const { return made; } ///< that were not in the folder
    /** Runs that one set of constants takes: scenes times packings. */
    std::size_t runs_of_a_set() const { return scenes.size() * seeds.size(); }
    int         together() const; ///< runs at a time

    /** What is run, and with which changes, for the constants at their start: a scene each. */
    std::vector<std::pair<std::string, std::vector<std::string>>> scenes_at_start() const;

    /**
     * "Material/flat-joint/Friction angle=0.3 degrees": a value of the search, with the unit where a scene's value would be questioned,
     * which is evaluated from bounds and start alone.
     */
    std::string change_of(const std::string &scene, const std::string &entry, double value) const;

  private:
    struct Job
    {
      std::string              scene;
      std::vector<std::string> changes;
      std::string              key; ///< of the folder
    };

    void             take_measured();
    void             find_units();
    void             demand_target(const CalibrationTarget &target, const Scene &scene) const;
    void             demand_reference(const CalibrationTarget &target) const;
    Job              job_of(const std::string &scene, const std::vector<std::string> &changes) const;
    std::string      scene_of(const CalibrationTarget &target) const;
    bool             is_constant_of(const SoughtConstant &constant, const std::string &scene) const;
    Eigen::VectorXd  at_start() const;
    Job              job_of(const std::string &scene, const Eigen::VectorXd &constants, const std::string &seed) const;
    std::vector<Job> jobs_of(const Eigen::VectorXd &constants) const;
    std::optional<std::string> message_of(const Job &job) const; ///< nothing: it was not run; "": it succeeded
    /** @throws base::InputError for a name that the run does not have */
    static Figure                  figure_of_run(const std::filesystem::path &run, const std::string &name);
    Eigen::VectorXd                values_of(const Job &job, std::size_t target) const;
    void                           work_off(const std::vector<Job> &jobs);
    std::optional<Eigen::VectorXd> mean_of(const Eigen::VectorXd &constants) const;

    std::filesystem::path folder_of(const Job &job) const { return options.folder / "runs" / job.key; }
    std::filesystem::path log_of(const Job &job) const { return options.folder / "runs" / (job.key + ".log"); }
    std::filesystem::path record_of(const Job &job) const { return options.folder / "journal" / (job.key + ".json"); }

    const CalibrationFile                                     &calibration;
    const StudyOptions                                        &options;
    Fidelity                                                   fidelity;
    std::vector<std::string>                                   scenes, seeds, changes;
    std::vector<Eigen::Index>                                  begins; ///< of each target, and the end
    std::vector<std::pair<std::string, std::string>>           labels; ///< of each target
    Eigen::VectorXd                                            observed, places, deviations;
    std::map<std::pair<std::string, std::string>, std::string> units; ///< of entries, by scene and path
    int                                                        made    = 0;
    double                                                     longest = 0; ///< of the runs [s]
  };
} // namespace apps
