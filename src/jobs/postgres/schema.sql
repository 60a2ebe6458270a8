-- Jobs, the parts of their answers, the keys that name submissions, and what every client has of all this.

CREATE TABLE jobs (
    id uuid PRIMARY KEY,
    client text NOT NULL,
    name text,
    -- 0 accepted, 1 running, 2 successful, 3 failed, 4 dismissed
    status smallint NOT NULL DEFAULT 0,
    -- Clients take turns: jobs are taken by round, then by id.
    round bigint NOT NULL,
    created timestamptz NOT NULL DEFAULT clock_timestamp(),
    started timestamptz,
    finished timestamptz,
    -- Seconds a worker was at it.
    wall_time double precision,
    -- How far its analysis has come.
    load_factor double precision,
    events bigint,
    percent double precision,
    -- JSON; why a failed job has no answer.
    failure text,
    -- What its analysis takes, and what request, answer and record take.
    memory bigint NOT NULL,
    bytes bigint NOT NULL,
    -- A client has learnt how it ended.
    read boolean NOT NULL DEFAULT false,
    -- In whose hands it is, and until when if nothing is heard of them.
    lease uuid,
    leased_until timestamptz,
    -- How many workers took it.
    attempts smallint NOT NULL DEFAULT 0
);

CREATE INDEX jobs_waiting ON jobs (round, id) WHERE status = 0;
CREATE INDEX jobs_waiting_of_client ON jobs (client, round) WHERE status = 0;
CREATE INDEX jobs_running ON jobs (leased_until) WHERE status = 1;
CREATE INDEX jobs_finished ON jobs (finished) WHERE status > 1;
CREATE INDEX jobs_to_go ON jobs (client, read DESC, finished, id) WHERE status > 1;
CREATE INDEX jobs_of_client ON jobs (client, id);
CREATE INDEX jobs_of_status ON jobs (status, id);

-- Apart from the rest, which is looked through often.
CREATE TABLE requests (
    job uuid PRIMARY KEY REFERENCES jobs ON DELETE CASCADE,
    body bytea NOT NULL
);

CREATE TABLE parts (
    job uuid NOT NULL REFERENCES jobs ON DELETE CASCADE,
    place smallint NOT NULL,
    names text[] NOT NULL,
    format text NOT NULL,
    -- The part, or why the answer has none; how many bytes it has where it is packed.
    body bytea,
    missing text,
    packed_from bigint,
    PRIMARY KEY (job, place)
);

-- What is large is packed already.
ALTER TABLE parts ALTER COLUMN body SET STORAGE EXTERNAL;

CREATE TABLE keys (
    key text PRIMARY KEY,
    job uuid NOT NULL,
    client text NOT NULL,
    -- SHA-256 of the request.
    digest bytea NOT NULL,
    bytes bigint NOT NULL,
    given timestamptz NOT NULL DEFAULT clock_timestamp()
);

CREATE INDEX keys_given ON keys (given);

-- Sums over jobs and keys, which would take long to count.
CREATE TABLE accounts (
    client text PRIMARY KEY,
    waiting bigint NOT NULL,
    finished bigint NOT NULL,
    bytes bigint NOT NULL
);

CREATE FUNCTION account(whose text, waiting integer, finished integer, bytes bigint) RETURNS void LANGUAGE sql AS $$
    INSERT INTO accounts AS known VALUES ($1, $2, $3, $4) ON CONFLICT (client) DO UPDATE SET
        waiting = known.waiting + $2, finished = known.finished + $3, bytes = known.bytes + $4
$$;

CREATE FUNCTION job_changed() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    PERFORM account(
        coalesce(NEW.client, OLD.client),
        coalesce((NEW.status = 0)::integer, 0) - coalesce((OLD.status = 0)::integer, 0),
        coalesce((NEW.status > 1)::integer, 0) - coalesce((OLD.status > 1)::integer, 0),
        coalesce(NEW.bytes, 0) - coalesce(OLD.bytes, 0)
    );
    IF TG_OP <> 'DELETE' THEN
        PERFORM pg_notify('voussoir', NEW.id || ' ' || NEW.status);
    END IF;
    RETURN NULL;
END
$$;

CREATE TRIGGER job_changed AFTER INSERT OR DELETE OR UPDATE OF status ON jobs
    FOR EACH ROW EXECUTE FUNCTION job_changed();

CREATE FUNCTION key_changed() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    IF TG_OP <> 'INSERT' THEN
        PERFORM account(OLD.client, 0, 0, -OLD.bytes);
    END IF;
    IF TG_OP <> 'DELETE' THEN
        PERFORM account(NEW.client, 0, 0, NEW.bytes);
    END IF;
    RETURN NULL;
END
$$;

CREATE TRIGGER key_changed AFTER INSERT OR DELETE OR UPDATE OF client, bytes ON keys
    FOR EACH ROW EXECUTE FUNCTION key_changed();
