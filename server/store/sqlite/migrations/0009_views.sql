-- Views of setpoints (api/views/views.hpp): small data from which charts and pages are answered. zstd.
CREATE TABLE views (
  seq INTEGER NOT NULL,
  name TEXT NOT NULL,
  part INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (seq, name, part)
) STRICT;
-- The version of the job's views; 0: none yet.
ALTER TABLE results ADD COLUMN views INTEGER NOT NULL DEFAULT 0;
