-- What ended first, for the retention.
CREATE INDEX jobs_ended ON jobs (finished_at) WHERE finished_at IS NOT NULL;

-- The owner of a removed job, who alone may know of it.
ALTER TABLE removals ADD COLUMN owner TEXT;
