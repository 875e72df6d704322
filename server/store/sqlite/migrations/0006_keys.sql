-- Who may ask. `hash` is the SHA-256 of the key's text. Removed keys stay: a service that has had keys never answers without one.
CREATE TABLE keys (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  scopes TEXT NOT NULL,
  hash TEXT NOT NULL,
  max_queued INTEGER,
  max_planning_ms INTEGER,
  created_at INTEGER NOT NULL,
  removed_at INTEGER
) STRICT, WITHOUT ROWID;
CREATE TABLE key_version (version INTEGER NOT NULL) STRICT;
INSERT INTO key_version VALUES (0);
CREATE TRIGGER keys_inserted AFTER INSERT ON keys BEGIN UPDATE key_version SET version = version + 1; END;
CREATE TRIGGER keys_updated AFTER UPDATE ON keys BEGIN UPDATE key_version SET version = version + 1; END;

-- The name of the key that posted the job; NULL: none. Indexes of jobs with an owner cost nothing where there are no keys.
ALTER TABLE jobs ADD COLUMN owner TEXT;
CREATE INDEX jobs_owner ON jobs (owner, id) WHERE owner IS NOT NULL;
CREATE INDEX jobs_owner_state ON jobs (owner, state, id) WHERE owner IS NOT NULL;

-- Owners take turns: among jobs of one priority the first of each owner come before the second ones.
ALTER TABLE jobs ADD COLUMN turn INTEGER NOT NULL DEFAULT 0;
DROP INDEX jobs_queue;
CREATE INDEX jobs_queue ON jobs (priority DESC, turn, seq) WHERE state = 'queued';
CREATE INDEX jobs_owner_queue ON jobs (owner, priority, turn) WHERE state = 'queued' AND owner IS NOT NULL;

-- The time that planners spent on an owner's jobs on the last day (days since 1970 UTC) on which one ended.
CREATE TABLE planning_use (
  owner TEXT PRIMARY KEY,
  day INTEGER NOT NULL,
  ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TRIGGER jobs_planned AFTER UPDATE OF state ON jobs
WHEN OLD.owner IS NOT NULL AND OLD.state = 'running' AND NEW.finished_at IS NOT NULL BEGIN
  INSERT INTO planning_use VALUES (NEW.owner, NEW.finished_at / 86400000, max(0, NEW.finished_at - OLD.started_at))
  ON CONFLICT (owner) DO UPDATE SET ms = iif(day = excluded.day, ms, 0) + excluded.ms, day = excluded.day;
END;
