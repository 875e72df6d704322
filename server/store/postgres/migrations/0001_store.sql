-- Ids are UUIDs of version 7, whose order is the order of acceptance. Each job's row is written three times: posted, claimed, ended. What changes while a
-- job runs is in `runs`. Names are compared by their bytes (COLLATE "C"), so that indexes serve prefixes.
CREATE TABLE jobs (
  id uuid PRIMARY KEY,
  kind text COLLATE "C" NOT NULL,
  name text COLLATE "C",
  reference text COLLATE "C",
  owner text COLLATE "C",
  tags text[] COLLATE "C",
  rank int NOT NULL,
  turn bigint NOT NULL,
  needs int NOT NULL,
  deadline timestamptz,
  time_budget double precision,
  state text COLLATE "C" NOT NULL CHECK (state IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
  fraction double precision NOT NULL DEFAULT 0,
  stage text NOT NULL DEFAULT '',
  message text NOT NULL DEFAULT '',
  attempt int NOT NULL DEFAULT 0,
  token bigint NOT NULL DEFAULT 0,
  ended_by uuid,
  suspect boolean NOT NULL DEFAULT false,
  losses int NOT NULL DEFAULT 0,
  cancel_requested boolean NOT NULL DEFAULT false,
  created_at timestamptz NOT NULL,
  started_at timestamptz,
  finished_at timestamptz,
  error text,
  revision bigint NOT NULL DEFAULT 1,
  callback text,
  callback_secret text,
  callback_receiver text COLLATE "C",
  callback_attempts int NOT NULL DEFAULT 0,
  callback_due timestamptz,
  callback_delivered timestamptz,
  callback_error text
) WITH (autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 5000, autovacuum_analyze_scale_factor = 0, autovacuum_analyze_threshold = 5000);
CREATE INDEX jobs_queue ON jobs (rank, turn, id) WHERE state = 'queued';
-- The index is empty as long as planners of level 0 do for all.
CREATE INDEX jobs_needs ON jobs (needs) WHERE state = 'queued' AND needs > 0;
CREATE INDEX jobs_owner_queue ON jobs (owner, rank, turn) WHERE state = 'queued' AND owner IS NOT NULL;
CREATE INDEX jobs_deadline ON jobs (deadline) WHERE state = 'queued' AND deadline IS NOT NULL;
CREATE INDEX jobs_state ON jobs (state, id);
CREATE INDEX jobs_kind ON jobs (kind, id);
CREATE INDEX jobs_reference ON jobs (reference, id) WHERE reference IS NOT NULL;
CREATE INDEX jobs_name ON jobs (name, id) WHERE name IS NOT NULL;
CREATE INDEX jobs_owner ON jobs (owner, id) WHERE owner IS NOT NULL;
CREATE INDEX jobs_ended ON jobs (finished_at) WHERE finished_at IS NOT NULL;
CREATE INDEX jobs_callback ON jobs (callback_receiver, callback_due) WHERE callback_due IS NOT NULL;

-- The attempts that run. Heartbeats and progress write this table alone. It has no index beside its key, and room in its pages, so that they are HOT updates.
-- `lease_ms` is the length of the lease, NULL without an end.
CREATE TABLE runs (
  id uuid PRIMARY KEY REFERENCES jobs,
  token bigint NOT NULL,
  worker text COLLATE "C" NOT NULL,
  lease_until timestamptz NOT NULL,
  lease_ms bigint,
  suspect boolean NOT NULL,
  fraction double precision NOT NULL DEFAULT 0,
  stage text NOT NULL DEFAULT '',
  message text NOT NULL DEFAULT '',
  revision bigint NOT NULL DEFAULT 0
) WITH (fillfactor = 50, autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000);

-- Documents, results, setpoints and views, zstd: the server does not pack them again. They are partitioned by the time in their id; what no partition of its
-- own takes is in the default one.
CREATE TABLE specs (
  id uuid PRIMARY KEY,
  document bytea NOT NULL,
  checked boolean NOT NULL
) PARTITION BY RANGE (id);
CREATE TABLE specs_rest PARTITION OF specs DEFAULT;
ALTER TABLE specs ALTER COLUMN document SET STORAGE EXTERNAL;
ALTER TABLE specs_rest ALTER COLUMN document SET STORAGE EXTERNAL;

CREATE TABLE results (
  id uuid PRIMARY KEY,
  token bigint NOT NULL,
  document bytea NOT NULL,
  columns text,
  row_count bigint NOT NULL DEFAULT 0,
  chunk_rows bigint NOT NULL DEFAULT 0,
  cycle_time double precision NOT NULL DEFAULT 0,
  views int NOT NULL DEFAULT 0,
  planned_by text NOT NULL DEFAULT ''
) PARTITION BY RANGE (id);
CREATE TABLE results_rest PARTITION OF results DEFAULT;
ALTER TABLE results ALTER COLUMN document SET STORAGE EXTERNAL;
ALTER TABLE results_rest ALTER COLUMN document SET STORAGE EXTERNAL;

-- Rows of another token than the result's are of a lost attempt: nobody reads them, and they are swept.
CREATE TABLE chunks (
  id uuid NOT NULL,
  token bigint NOT NULL,
  first_row bigint NOT NULL,
  row_count bigint NOT NULL,
  data bytea NOT NULL,
  PRIMARY KEY (id, token, first_row)
) PARTITION BY RANGE (id);
CREATE TABLE chunks_rest PARTITION OF chunks DEFAULT;
ALTER TABLE chunks ALTER COLUMN data SET STORAGE EXTERNAL;
ALTER TABLE chunks_rest ALTER COLUMN data SET STORAGE EXTERNAL;

CREATE TABLE views (
  id uuid NOT NULL,
  token bigint NOT NULL,
  name text COLLATE "C" NOT NULL,
  part bigint NOT NULL,
  data bytea NOT NULL,
  PRIMARY KEY (id, token, name, part)
) PARTITION BY RANGE (id);
CREATE TABLE views_rest PARTITION OF views DEFAULT;
ALTER TABLE views ALTER COLUMN data SET STORAGE EXTERNAL;
ALTER TABLE views_rest ALTER COLUMN data SET STORAGE EXTERNAL;

-- Chunks and views that are to be swept, piece by piece: those of one token, or all of the job where it is 0.
CREATE TABLE leftovers (
  id uuid NOT NULL,
  token bigint NOT NULL,
  PRIMARY KEY (id, token)
);

-- The owner '' is none.
CREATE TABLE idempotency_keys (
  owner text COLLATE "C" NOT NULL,
  key text COLLATE "C" NOT NULL,
  body_hash text NOT NULL,
  id uuid NOT NULL,
  PRIMARY KEY (owner, key)
);
CREATE INDEX idempotency_keys_id ON idempotency_keys (id);

-- The jobs that have a tag: under the owner '' of all jobs, and under the job's own.
CREATE TABLE job_tags (
  owner text COLLATE "C" NOT NULL,
  tag text COLLATE "C" NOT NULL,
  id uuid NOT NULL,
  PRIMARY KEY (owner, tag, id)
);

-- How many jobs of an owner ('': none) are in a state is the sum of its rows. A transaction adds rows and changes none, so that no two wait for each other.
CREATE TABLE count_deltas (
  state text COLLATE "C" NOT NULL,
  owner text COLLATE "C" NOT NULL,
  jobs bigint NOT NULL
) WITH (autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 1000);

-- The time that planners spent on an owner's jobs on the last day (days since 1970 UTC) on which one ended.
CREATE TABLE planning_use (
  owner text COLLATE "C" PRIMARY KEY,
  day bigint NOT NULL,
  ms bigint NOT NULL
);

-- Changes of jobs by the transactions that made them. A sequence number would become visible out of order; `change_numbers` gives each job with a committed
-- change the next number, by one transaction at a time, which has seen the changes visible in `snapshot`. Numbers begin at the microseconds since 1970, so that
-- they go on growing where a crash has emptied these tables. Changes up to number `lowest` may have been forgotten.
CREATE UNLOGGED TABLE changes (
  xid xid8 NOT NULL DEFAULT pg_current_xact_id(),
  id uuid NOT NULL,
  owner text COLLATE "C",
  at timestamptz NOT NULL DEFAULT now()
) WITH (autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 5000);
CREATE INDEX changes_xid ON changes (xid);
CREATE UNLOGGED TABLE change_numbers (
  id uuid PRIMARY KEY,
  owner text COLLATE "C",
  number bigint NOT NULL,
  gone boolean NOT NULL,
  at timestamptz NOT NULL DEFAULT now()
) WITH (autovacuum_vacuum_scale_factor = 0, autovacuum_vacuum_threshold = 5000);
CREATE INDEX change_numbers_number ON change_numbers (number);
CREATE INDEX change_numbers_gone ON change_numbers (number) WHERE gone;
CREATE UNLOGGED TABLE change_feed (
  one boolean PRIMARY KEY DEFAULT true CHECK (one),
  snapshot pg_snapshot NOT NULL,
  last bigint NOT NULL,
  lowest bigint NOT NULL
) WITH (fillfactor = 10);

-- Who may ask, as in the SQLite store.
CREATE TABLE keys (
  id text COLLATE "C" PRIMARY KEY,
  name text COLLATE "C" NOT NULL,
  scopes text NOT NULL,
  hash text NOT NULL,
  max_queued bigint,
  max_planning_ms bigint,
  created_at timestamptz NOT NULL,
  removed_at timestamptz
);
CREATE TABLE key_version (version bigint NOT NULL);
INSERT INTO key_version VALUES (0);

-- What one process at a time does for all, and until when.
CREATE TABLE duties (
  name text COLLATE "C" PRIMARY KEY,
  process text NOT NULL,
  until timestamptz NOT NULL
);
