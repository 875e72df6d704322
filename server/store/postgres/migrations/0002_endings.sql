-- Tokens of the lost attempts that `losses` counts: the worker of one that shows that it lives takes its own back.
ALTER TABLE jobs ADD COLUMN lost_tokens bigint[];

-- The version of the program whose attempt has ended the job; NULL: unknown, or not an attempt. It takes the place of results.planned_by, which nobody reads any
-- more.
ALTER TABLE jobs ADD COLUMN planned_by text;
