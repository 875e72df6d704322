-- From here on `specs` keeps the whole document as it was posted (`whole` = 1); rows written before keep the spec alone.
ALTER TABLE specs ADD COLUMN whole INTEGER NOT NULL DEFAULT 0;

-- Whose deadline passes next in the queue.
CREATE INDEX jobs_deadline ON jobs (deadline) WHERE state = 'queued' AND deadline IS NOT NULL;
