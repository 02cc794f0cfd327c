#pragma once

#include "base/state.h"

#include <filesystem>
#include <memory>
#include <string>

namespace postprocess
{
  /**
   * Stores a run's state in one HDF5 file that replaces the earlier checkpoint only when it is complete.
   *
   *     CheckpointWriter writer(path, scene);
   *     writer.group("specimen");  specimen.visit_state(writer);
   *     writer.group("driver");    driver.visit_state(writer);
   *     writer.commit();
   *
   * The state has a fingerprint; the file knows the series and snapshots beside it (companions.h). A name once per group.
   */
  class CheckpointWriter : public base::StateVisitor
  {
  public:
    /**
     * @param scene the text that decides what the run computes (the completed scene without folders, threads and the
     * like); a reader with another text is refused.
     * @throws OutputError.
     */
    CheckpointWriter(const std::filesystem::path &path, const std::string &scene);
    ~CheckpointWriter() override; ///< drops what was not committed

    void group(const std::string &name); ///< the items that follow belong to this group

    void column(const std::string &name, base::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override;
    void column_in_parts(const std::string &name, std::size_t count, const Tell &tell) override;
    void scalar(const std::string &name, double &value) override;
    void scalar(const std::string &name, std::int64_t &value) override;
    /** A text beside the state; it belongs to no group. */
    void text(const std::string &name, const std::string &value);

    /** Complete the file and put it in place. @throws OutputError; the earlier checkpoint then still stands. */
    void commit();

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self;
  };

  /** Fills a state from a checkpoint, to the same bits; the counterpart of CheckpointWriter. */
  class CheckpointReader : public base::StateVisitor
  {
  public:
    /**
     * @throws base::InputError if the file is missing, damaged, not a checkpoint, of another format version, made by another
     * scene (with the first line that differs), or a series, snapshot or state beside it has changed or gone since.
     */
    CheckpointReader(const std::filesystem::path &path, const std::string &scene);
    ~CheckpointReader() override;

    void group(const std::string &name);

    /** @throws base::InputError naming the item: missing, of another type or shape, or its checksum does not fit. */
    void column(const std::string &name, base::Column &values) override;
    void column(const std::string &name, std::vector<std::int32_t> &values) override;
    bool finds_by_name() const override { return true; }
    void read_in_parts(const std::string &name, const Take &take) override;
    void scalar(const std::string &name, double &value) override;
    void scalar(const std::string &name, std::int64_t &value) override;

    std::string text(const std::string &name) const;

    /** Call it last. @throws base::InputError if the file holds an item that was not read. */
    void finish() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> self;
  };

  /** A text of a checkpoint, whatever scene and state it is of; "" where there is none. */
  std::string text_of_checkpoint(const std::filesystem::path &path, const std::string &name);
} // namespace postprocess
