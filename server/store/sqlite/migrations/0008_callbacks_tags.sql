-- Whom to call when a job has ended; the URL is in `callback`. `callback_receiver` is its scheme, host and port. The outbox is the jobs whose callback is due:
-- the transaction that ends a job makes it so, whatever ends it.
ALTER TABLE jobs ADD COLUMN callback_secret TEXT;
ALTER TABLE jobs ADD COLUMN callback_receiver TEXT;
ALTER TABLE jobs ADD COLUMN callback_attempts INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN callback_due INTEGER;
ALTER TABLE jobs ADD COLUMN callback_delivered INTEGER;
ALTER TABLE jobs ADD COLUMN callback_error TEXT;
CREATE INDEX jobs_callback ON jobs (callback_receiver, callback_due) WHERE callback_due IS NOT NULL;
CREATE TRIGGER jobs_callback_due AFTER UPDATE OF state ON jobs
WHEN NEW.callback_receiver IS NOT NULL AND NEW.finished_at IS NOT NULL BEGIN
  UPDATE jobs SET callback_due = NEW.finished_at WHERE seq = NEW.seq;
END;

-- Tags, a JSON array, and for each one the jobs that have it: under the owner '' of all jobs, and under the job's own.
ALTER TABLE jobs ADD COLUMN tags TEXT;
CREATE TABLE job_tags (
  owner TEXT NOT NULL,
  tag TEXT NOT NULL,
  id TEXT NOT NULL,
  PRIMARY KEY (owner, tag, id)
) STRICT, WITHOUT ROWID;
CREATE TRIGGER jobs_tagged AFTER INSERT ON jobs WHEN NEW.tags IS NOT NULL BEGIN
  INSERT INTO job_tags SELECT '', value, NEW.id FROM json_each(NEW.tags);
  INSERT INTO job_tags SELECT NEW.owner, value, NEW.id FROM json_each(NEW.tags) WHERE NEW.owner IS NOT NULL;
END;
CREATE TRIGGER jobs_untagged AFTER DELETE ON jobs WHEN OLD.tags IS NOT NULL BEGIN
  DELETE FROM job_tags WHERE owner IN ('', OLD.owner) AND tag IN (SELECT value FROM json_each(OLD.tags)) AND id = OLD.id;
END;

-- How many jobs each owner ('': none) has in each state.
CREATE TABLE owner_counts (
  state TEXT NOT NULL,
  owner TEXT NOT NULL,
  jobs INTEGER NOT NULL,
  PRIMARY KEY (state, owner)
) STRICT, WITHOUT ROWID;
INSERT INTO owner_counts SELECT state, coalesce(owner, ''), count(*) FROM jobs GROUP BY 1, 2;
DROP TRIGGER jobs_inserted;
DROP TRIGGER jobs_moved;
DROP TRIGGER jobs_deleted;
DROP TABLE job_counts;
ALTER TABLE owner_counts RENAME TO job_counts;
CREATE TRIGGER jobs_inserted AFTER INSERT ON jobs BEGIN
  INSERT INTO job_counts VALUES (NEW.state, coalesce(NEW.owner, ''), 1) ON CONFLICT DO UPDATE SET jobs = jobs + 1;
END;
CREATE TRIGGER jobs_moved AFTER UPDATE OF state ON jobs WHEN OLD.state <> NEW.state BEGIN
  UPDATE job_counts SET jobs = jobs - 1 WHERE state = OLD.state AND owner = coalesce(OLD.owner, '');
  INSERT INTO job_counts VALUES (NEW.state, coalesce(NEW.owner, ''), 1) ON CONFLICT DO UPDATE SET jobs = jobs + 1;
END;
CREATE TRIGGER jobs_deleted AFTER DELETE ON jobs BEGIN
  UPDATE job_counts SET jobs = jobs - 1 WHERE state = OLD.state AND owner = coalesce(OLD.owner, '');
END;

-- The list of one owner's jobs, or of those without owner, is found by an index whatever the filter; that of all owners is merged.
DROP INDEX jobs_state;
DROP INDEX jobs_owner_state;
DROP INDEX jobs_kind;
DROP INDEX jobs_reference;
CREATE INDEX jobs_state ON jobs (owner, state, id);
CREATE INDEX jobs_kind ON jobs (owner, kind, id);
CREATE INDEX jobs_reference ON jobs (owner, reference, id) WHERE reference IS NOT NULL;
CREATE INDEX jobs_name ON jobs (owner, name, id) WHERE name IS NOT NULL;
