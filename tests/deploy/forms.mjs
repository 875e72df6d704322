// forms.mjs ROOT: called by forms.sh. Exit code 1 when it printed a fault.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { validate } from 'dockerfile-utils';
import { parseAllDocuments } from 'yaml';

const root = process.argv[2];
const read = (name) => readFileSync(`${root}/${name}`, 'utf8');
const faults = [];
const expect = (condition, fault) => {
  if (!condition) faults.push(fault);
  return condition;
};
const same = (what, ...values) => {
  if (new Set(values.map((each) => JSON.stringify(each))).size !== 1) faults.push(`${what}: ${values.map((each) => JSON.stringify(each)).join(' and ')}`);
};

for (const { range, message } of validate(read('docker/Dockerfile')))
  faults.push(`docker/Dockerfile:${range.start.line + 1}: ${message}`);

// The objects of a folder; its kustomization lists all of its files but the examples.
function manifests(folder) {
  const objects = [];
  for (const entry of readdirSync(`${root}/${folder}`, { withFileTypes: true }))
    if (entry.isFile())
      for (const document of parseAllDocuments(read(`${folder}/${entry.name}`), { merge: true })) {
        for (const error of document.errors) faults.push(`${folder}/${entry.name}: ${error.message}`);
        objects.push({ name: entry.name, file: `${folder}/${entry.name}`, value: document.toJS() });
      }
  const kustomization = objects.find(({ value }) => value.kind === 'Kustomization').value;
  const others = objects.filter(({ value }) => value.kind !== 'Kustomization');
  same(`what ${folder}/kustomization.yaml lists`, [...kustomization.resources].sort(),
    [...new Set(others.map(({ name }) => name).filter((name) => !name.includes('.example.')))].sort());
  return others;
}
const single = manifests('deploy/kubernetes'), shared = manifests('deploy/kubernetes/postgres');

let types = '';
for (const [k, { file, value }] of [...single, ...shared].entries()) {
  const module = `${value.apiVersion.startsWith('keda.sh/') ? '@kubernetes-models/keda' : 'kubernetes-models'}/${value.apiVersion}/${value.kind}`;
  const { [value.kind]: Model } = await import(module);
  try {
    new Model(value).validate();
  } catch (error) {
    faults.push(`${file}: ${error.message}`);
  }
  types += `import type { I${value.kind} as T${k} } from '${module}';\nexport const object${k}: T${k} = ${JSON.stringify(value, null, 2)};\n`;
}
writeFileSync('manifests.ts', types);

const bytes = (text) => {
  const [, number, unit] = /^(\d+)([KMG]i)B?$/.exec(text);
  return Number(number) * 1024 ** (1 + ['Ki', 'Mi', 'Gi'].indexOf(unit));
};
const environment = (container) => Object.fromEntries(container.env.map(({ name, value, valueFrom }) => [name, value ?? valueFrom]));
const matches = (selector, labels) => Object.entries(selector).every(([name, value]) => labels[name] === value);
const user = /^USER (\d+):(\d+)$/m.exec(read('docker/Dockerfile')).slice(1).map(Number);

// What belongs together within a pod.
function checkPod({ metadata, spec }, file) {
  const [container] = spec.containers;
  same(`${file}: the user`, user, [spec.securityContext.runAsUser, spec.securityContext.runAsGroup]);
  // The namespace demands it.
  expect(spec.securityContext.runAsNonRoot && spec.securityContext.seccompProfile.type === 'RuntimeDefault' && !container.securityContext.allowPrivilegeEscalation
    && container.securityContext.readOnlyRootFilesystem && container.securityContext.capabilities.drop.includes('ALL'), `${file}: the pod has more rights than it needs`);
  if (!container.ports) return;
  const env = environment(container);
  same(`${file}: the port`, env.BAHNWERK_LISTEN.split(':')[1], String(container.ports[0].containerPort), metadata.annotations['prometheus.io/port']);
  same(`${file}: the port's name`, container.ports[0].name, ...['startupProbe', 'livenessProbe', 'readinessProbe'].map((probe) => container[probe].httpGet.port));
  const wait = Number(container.lifecycle?.preStop.exec.command[1] ?? 0);
  expect(wait + Number(env.BAHNWERK_DRAIN_TIMEOUT) + 10 <= spec.terminationGracePeriodSeconds, `${file}: the pod is killed before its drain is over`);
  same(`${file}: three quarters of the memory`, 0.75 * bytes(container.resources.limits.memory), bytes(env.BAHNWERK_MAX_MEMORY));
}

// One process with its file: selectors, ports, the store's place on its volume.
{
  const byKind = Object.fromEntries(single.map(({ value }) => [value.kind, value]));
  const { template, selector, volumeClaimTemplates } = byKind.StatefulSet.spec;
  const [container] = template.spec.containers;
  checkPod(template, 'statefulset.yaml');
  same('the pods', template.metadata.labels, selector.matchLabels, byKind.Service.spec.selector, byKind.PodDisruptionBudget.spec.selector.matchLabels,
    byKind.NetworkPolicy.spec.podSelector.matchLabels);
  const store = environment(container).BAHNWERK_STORE.replace('sqlite:', '');
  const mount = container.volumeMounts.find(({ name }) => name === volumeClaimTemplates[0].metadata.name);
  expect(store.startsWith(`${mount.mountPath}/`), `the store ${store} is not on the volume ${mount.mountPath}`);
  same('the port\'s name', container.ports[0].name, byKind.Service.spec.ports[0].targetPort, byKind.NetworkPolicy.spec.ingress[0].ports[0].port);
  expect(byKind.StatefulSet.spec.replicas === 1, 'a SQLite file has one owner');
  same('the namespace', byKind.Namespace, shared.find(({ value }) => value.kind === 'Namespace').value);
}

// Processes that share a database.
{
  const of = (kind) => shared.filter(({ value }) => value.kind === kind);
  const one = (kind, name) => of(kind).find(({ value }) => value.metadata.name === name)?.value;
  const workloads = [...of('Deployment'), ...of('Job')];
  const deployments = Object.fromEntries(of('Deployment').map(({ value }) => [value.metadata.name, value]));
  const labels = workloads.map(({ value }) => value.spec.template.metadata.labels);
  const elsewhere = single.find(({ value }) => value.kind === 'StatefulSet').value.spec.template.metadata.labels;
  for (const { file, value } of workloads) {
    const { spec, metadata } = value.spec.template;
    const [container] = spec.containers;
    checkPod(value.spec.template, file);
    // Both installations may be in one namespace.
    expect(!matches(elsewhere, metadata.labels), `${file}: the labels are those of the StatefulSet's pods`);
    const { BAHNWERK_STORE: url, BAHNWERK_STORE_PASSWORD_FILE: password } = environment(container);
    expect(one('ConfigMap', url.configMapKeyRef.name)?.data[url.configMapKeyRef.key]?.startsWith('postgresql://'), `${file}: no address of a store`);
    const mount = container.volumeMounts.find(({ mountPath }) => password.startsWith(`${mountPath}/`));
    const { secret } = spec.volumes.find(({ name }) => name === mount.name);
    expect(one('Secret', secret.secretName)?.stringData[password.slice(mount.mountPath.length + 1)], `${file}: no password in the Secret`);
    expect(secret.defaultMode === 0o440 && spec.securityContext.fsGroup === spec.securityContext.runAsGroup, `${file}: who may read the password`);
  }
  for (const { file, value } of of('Deployment')) {
    same(`${file}: the pods`, value.spec.selector.matchLabels, value.spec.template.metadata.labels,
      ...value.spec.template.spec.topologySpreadConstraints.map(({ labelSelector }) => labelSelector.matchLabels));
    for (const kind of ['PodDisruptionBudget', 'HorizontalPodAutoscaler']) expect(one(kind, value.metadata.name), `${file}: no ${kind} of its name`);
    expect(!('replicas' in value.spec), `${file}: its number is the autoscaler's`);
    same(`${file}: its role`, container(value).args, ['serve', '--role', value.metadata.labels['app.kubernetes.io/component']]);
  }
  for (const { value } of of('PodDisruptionBudget'))
    same(`the budget ${value.metadata.name}`, value.spec.selector.matchLabels, deployments[value.metadata.name].spec.selector.matchLabels);
  const [service] = of('Service');
  same('the service', service.value.spec.selector, deployments['bahnwerk-api'].spec.selector.matchLabels);
  for (const { value } of of('NetworkPolicy')) {
    expect(labels.some((each) => matches(value.spec.podSelector.matchLabels, each)), `${value.metadata.name} selects no pod`);
    for (const { ports } of value.spec.ingress ?? []) same('the port\'s name', 'http', ...ports.map(({ port }) => port));
  }
  const closed = of('NetworkPolicy').filter(({ value }) => value.spec.policyTypes.includes('Egress'));
  expect(labels.every((each) => closed.some(({ value }) => matches(value.spec.podSelector.matchLabels, each))), 'a pod may reach everything');
  // The most processes there can be, one more of each during an update, and the Job, fit into the default of max_connections less those of superusers.
  let connections = 1;
  for (const { file, value } of [...of('HorizontalPodAutoscaler'), ...of('ScaledObject')]) {
    const target = deployments[value.spec.scaleTargetRef?.name];
    if (!expect(target && container(target).resources.requests.cpu, `${file}: it scales nothing that asks for processor time`)) continue;
    const most = value.spec.maxReplicas ?? value.spec.maxReplicaCount;
    if (value.kind === 'ScaledObject') same(`${file}: the largest number`, most, one('HorizontalPodAutoscaler', value.metadata.name).spec.maxReplicas);
    else connections += (most + target.spec.strategy.rollingUpdate.maxSurge) * Number(environment(container(target)).BAHNWERK_STORE_CONNECTIONS);
  }
  expect(connections <= 97, `the processes may have ${connections} connections to the database`);
}

// The containers of one machine that share a database: who waits for whom, and that they mean the same database.
{
  const { services, secrets } = parseAllDocuments(read('deploy/compose.postgres.yaml'), { merge: true })[0].toJS();
  const { postgres, migrate, ...processes } = services;
  same('who waits for the schema', Object.keys(processes), Object.keys(processes).filter((name) => processes[name].depends_on.migrate?.condition === 'service_completed_successfully'));
  same('what makes the schema', [migrate.command, Object.keys(migrate.depends_on), migrate.depends_on.postgres.condition], [['migrate'], ['postgres'], 'service_healthy']);
  expect(postgres.healthcheck.test.join(' ').includes('-h 127.0.0.1'), 'a server that makes its files is taken for a healthy one');
  const { POSTGRES_USER: name, POSTGRES_DB: database, POSTGRES_PASSWORD_FILE: password } = postgres.environment;
  same('the roles', Object.values(processes).map(({ environment }) => environment.BAHNWERK_ROLE), ['api', 'api', 'worker', 'worker']);
  for (const [service, { environment, ...of }] of Object.entries({ migrate, ...processes })) {
    same(`${service}: the store`, environment.BAHNWERK_STORE, `postgresql://${name}@postgres/${database}`);
    same(`${service}: the password`, environment.BAHNWERK_STORE_PASSWORD_FILE, password, `/run/secrets/${of.secrets[0]}`);
    expect(secrets[of.secrets[0]], `${service}: there is no such secret`);
    expect(parseInt(of.stop_grace_period) >= Number(environment.BAHNWERK_DRAIN_TIMEOUT) + 10, `${service}: it is killed before its drain is over`);
    const [, number, unit] = /^(\d+)([mg])$/.exec(of.mem_limit);
    if (service !== 'migrate') same(`${service}: three quarters of the memory`, 0.75 * bytes(`${number}${unit.toUpperCase()}i`), bytes(environment.BAHNWERK_MAX_MEMORY));
  }
  const published = Object.values(services).flatMap(({ ports = [] }) => ports);
  expect(published.length === 2 && published.every((each) => each.startsWith('127.0.0.1:')) && new Set(published).size === 2, `published: ${published}`);
}

function container(workload) {
  return workload.spec.template.spec.containers[0];
}

for (const fault of faults) console.error(fault);
process.exit(faults.length ? 1 : 0);
