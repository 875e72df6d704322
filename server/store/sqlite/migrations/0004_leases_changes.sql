-- Who plans a running job, and until when without a heartbeat (ms since 1970 UTC).
ALTER TABLE jobs ADD COLUMN worker TEXT;
ALTER TABLE jobs ADD COLUMN lease_until INTEGER;
UPDATE jobs SET lease_until = 0 WHERE state = 'running';
CREATE INDEX jobs_lease ON jobs (lease_until) WHERE state = 'running';

-- The number of the job's last change, greater than all before it; 0 = none since this column is there.
ALTER TABLE jobs ADD COLUMN changed INTEGER NOT NULL DEFAULT 0;
CREATE UNIQUE INDEX jobs_changed ON jobs (changed) WHERE changed > 0;

-- The last removals; `n` counts them, so that a fixed number is kept.
CREATE TABLE removals (
  n INTEGER PRIMARY KEY,
  changed INTEGER NOT NULL UNIQUE,
  id TEXT NOT NULL
) STRICT;
