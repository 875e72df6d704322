-- One result per job, stored once: `document` is the result document, zstd; `columns` a JSON array of {name, unit}.
CREATE TABLE results (
  seq INTEGER PRIMARY KEY REFERENCES jobs (seq) ON DELETE CASCADE,
  document BLOB NOT NULL,
  columns TEXT,
  row_count INTEGER NOT NULL DEFAULT 0,
  chunk_rows INTEGER NOT NULL DEFAULT 0,
  cycle_time REAL NOT NULL DEFAULT 0
) STRICT;

-- Setpoints, `row_count` rows from `first_row` on (all chunks of a job have results.chunk_rows rows, the last one maybe fewer).
CREATE TABLE chunks (
  seq INTEGER NOT NULL REFERENCES jobs (seq) ON DELETE CASCADE,
  first_row INTEGER NOT NULL,
  row_count INTEGER NOT NULL,
  data BLOB NOT NULL,
  PRIMARY KEY (seq, first_row)
) STRICT;
