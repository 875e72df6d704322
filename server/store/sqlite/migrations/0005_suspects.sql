-- A job that was running when its process ended is a suspect until it has ended: it is planned alone, and `losses` counts those of its attempts that
-- were lost while nothing else ran.
ALTER TABLE jobs ADD COLUMN suspect INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN losses INTEGER NOT NULL DEFAULT 0;

-- Jobs whose rows of setpoints are still to be removed, piece by piece. `seq` is never reused, so that nobody sees them.
CREATE TABLE leftovers (
  seq INTEGER PRIMARY KEY
) STRICT;
