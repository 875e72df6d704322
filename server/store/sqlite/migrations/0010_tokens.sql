-- The number of the job's last claim: what every write of the attempt is conditional on. The attempt's number returns to use when a job is put back.
ALTER TABLE jobs ADD COLUMN token INTEGER NOT NULL DEFAULT 0;
UPDATE jobs SET token = attempt WHERE attempt > 0;
