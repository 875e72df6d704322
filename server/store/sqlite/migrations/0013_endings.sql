-- Tokens of the lost attempts that `losses` counts, a JSON array: the worker of one that shows that it lives takes its own back.
ALTER TABLE jobs ADD COLUMN lost_tokens TEXT;

-- The token of the attempt that has ended the job, by its result or its error: repeated, its call counts as done. NULL: nobody has, or not an attempt.
ALTER TABLE jobs ADD COLUMN ended_by INTEGER;

-- The version of the program whose attempt has ended the job; NULL: unknown, or not an attempt. It takes the place of results.planned_by, which nobody reads any more.
ALTER TABLE jobs ADD COLUMN planned_by TEXT;
