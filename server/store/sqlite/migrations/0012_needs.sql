-- The level of planners (api/engine_level.hpp) that the job needs: programs of a lower one leave it in the queue. The index is empty as long as level 0 does for
-- all.
ALTER TABLE jobs ADD COLUMN needs INTEGER NOT NULL DEFAULT 0;
CREATE INDEX jobs_needs ON jobs (needs) WHERE state = 'queued' AND needs > 0;
