// The types generated from the OpenAPI document: a request is one of them, and an answer is read by them.
import type { components, operations } from "./document";

type Request = components["schemas"]["AnalysisRequest"];
type Answer = operations["get_results"]["responses"][200]["content"]["application/json"];

const request: Request = {
  arch: {
    profile: { circular: { radius_m: 10, opening_angle_deg: 180 } },
    thickness: { constant_m: 1 },
    voussoirs: 27,
  },
  loads: [
    { load: { self_weight: {} } },
    { load: { point_load: { x_m: -5, force_n_per_m: 1000 } }, scaled: true },
  ],
};

// @ts-expect-error a request without loads is none
({ arch: request.arch }) satisfies Request;

export async function collapse(service: string): Promise<number | undefined> {
  const headers = { "content-type": "application/json", prefer: "wait=30" };
  const submitted = await fetch(`${service}/v1/jobs`, { method: "POST", headers, body: JSON.stringify(request) });
  const job: components["schemas"]["JobStatus"] = await submitted.json();
  const answer: Answer = await (await fetch(`${service}/v1/jobs/${job.job_id}/results`)).json();
  return "ends" in answer ? answer.ends[0]?.intensity : undefined;
}
