-- The versions of the schema from this one on, and which version a program has to know, at least, that uses the store since then: an older program goes on with
-- a newer store that only has more.
CREATE TABLE schema_version (
  version INTEGER PRIMARY KEY,
  min_reader INTEGER NOT NULL
) STRICT;

-- The version of the program that planned; empty: unknown.
ALTER TABLE results ADD COLUMN planned_by TEXT NOT NULL DEFAULT '';
